import { Devices } from "../parts/devices";
import { Readings } from "../parts/readings";
import { RunPanel } from "../parts/run-panel";
import { StartForm } from "../parts/start-form";

export function StationView() {
  return (
    <div class="station">
      <h1 class="hidden">Station</h1>
      <div class="side">
        <StartForm />
        <Devices />
      </div>
      <div class="work">
        <RunPanel />
        <Readings />
      </div>
    </div>
  );
}
