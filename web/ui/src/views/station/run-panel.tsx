import { duration, fixed } from "../../format";
import { finished, machineAgeS, remainingS, station } from "../../live";
import { AbortButton } from "./abort";
import { WorkspaceMap } from "./map";
import { Outcome, outcome } from "./outcome";

/** Values older than this are marked as old. */
const STALE_S = 3;

export function RunPanel() {
  const run = station.value?.run;
  const step = run?.step ?? 0;
  const steps = run?.steps ?? 0;
  return (
    <section class="run" aria-label="Run">
      <div class="top">
        <Outcome />
        <div class="progress" hidden={outcome.value !== null}>
          <h2>{run ? (run.walk?.title ?? "Waiting to start") : "No run under way"}</h2>
          <p>{run && `${run.robot_serial} · run ${run.id} · ${run.operator}`}</p>
          <progress aria-label="Progress" value={step} max={Math.max(steps, 1)} />
          <p>{run ? `step ${step} of ${steps || "?"}` : ""}</p>
          <p>{run && remainingS.value !== null ? `about ${duration(remainingS.value)} left in this pass` : ""}</p>
        </div>
        <AbortButton />
      </div>
      <WorkspaceMap run={run ?? finished.value} />
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
      <Value name="Scale" unit="mm" value={machine?.scale_mm} digits={4} />
      <div>
        <dt>Age</dt>
        <dd class={old ? "alarm warn" : ""}>
          {machine ? `${old ? "◆ old " : ""}${fixed(machineAgeS.value, 1)} s` : "no values"}
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
