import { t } from "../../messages";
import { CalibrationHolds } from "./calibration-holds";
import { Devices } from "./devices";
import { Readings } from "./readings";
import { Retract } from "./retract";
import { RunPanel } from "./run-panel";
import { StartForm } from "./start-form";

export function StationView() {
  return (
    <div class="station">
      <h1 class="hidden">{t.station.title}</h1>
      <div class="side">
        <CalibrationHolds />
        <Retract />
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
