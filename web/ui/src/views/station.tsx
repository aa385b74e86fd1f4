import { Devices } from "../parts/devices";
import { Outcome } from "../parts/outcome";
import { Readings } from "../parts/readings";
import { RunPanel } from "../parts/run-panel";
import { StartForm } from "../parts/start-form";

export function StationView() {
  return (
    <div class="station">
      <h1 class="hidden">Station</h1>
      <StartForm />
      <div class="work">
        <Outcome />
        <RunPanel />
        <div class="pair">
          <Readings />
          <Devices />
        </div>
      </div>
    </div>
  );
}
