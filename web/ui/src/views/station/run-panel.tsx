import { duration, fixed } from "../../format";
import { machineAgeS, remainingS, shownRun, station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { AbortButton } from "./abort";
import { MapKey, WorkspaceMap } from "./map";
import { Outcome, outcome } from "./outcome";
import { Prompt } from "./prompt";

/** Values older than this are marked as old. */
const STALE_S = 3;

export function RunPanel() {
  const run = station.value?.run;
  const step = run?.step ?? 0;
  const steps = run?.steps ?? 0;
  return (
    <section class="run" aria-label={t.station.run}>
      <div class="top">
        <Outcome />
        <div class="progress" hidden={outcome.value !== null}>
          <h2>{run ? (run.walk ? said(run.walk.title) : t.shared.waiting) : t.station.noRun}</h2>
          <p>{run && t.station.runLine(run.robot_serial, run.id, run.operator)}</p>
          <progress aria-label={t.station.progress} value={run?.progress ?? 0} max={1} />
          <p>{run && steps > 0 ? t.shared.stepOf(step, steps) : ""}</p>
          <p>
            {run && run.state !== "waiting" && remainingS.value !== null
              ? t.station.remaining(duration(remainingS.value))
              : ""}
          </p>
        </div>
        <AbortButton />
      </div>
      <Prompt />
      <MapKey />
      <WorkspaceMap run={shownRun.value} />
      <LiveValues />
    </section>
  );
}

function LiveValues() {
  const machine = station.value?.machine;
  const old = machine != null && machineAgeS.value > STALE_S;
  return (
    <dl class="values">
      <Value name="θ₁" unit="°" value={machine?.theta1_deg} digits={3} />
      <Value name="θ₂" unit="°" value={machine?.theta2_deg} digits={3} />
      <Value name="x" unit="mm" value={machine?.x_mm} digits={2} />
      <Value name="y" unit="mm" value={machine?.y_mm} digits={2} />
      <Value name={t.station.scale} unit="mm" value={machine?.scale_mm} digits={4} />
      <div>
        <dt>{t.station.age}</dt>
        <dd class={old ? "alarm warn" : ""}>
          {machine ? `${old ? `${t.station.old} ` : ""}${fixed(machineAgeS.value, 1)} s` : t.station.noValues}
        </dd>
      </div>
    </dl>
  );
}

function Value(props: { name: string; unit: string; value: number | null | undefined; digits: number }) {
  return (
    <div>
      <dt>{props.name}</dt>
      <dd>
        {fixed(props.value, props.digits)} <small>{props.unit}</small>
      </dd>
    </div>
  );
}
