/** What the drives hold of a run's zero offsets: write them, take them back. */
import { apply, newKey, rollBack } from "../../api";
import { signed } from "../../format";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { runKind } from "../../names";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { Link } from "../../parts/link";
import { MotionWarning } from "../../parts/motion-warning";
import { OperatorField } from "../../parts/operator-field";
import { Badge } from "../../parts/verdict";
import { reasonText } from "../../reason";
import type { ApplicationState, Calibration, Run } from "../../types";

type Drives = NonNullable<Calibration["application"]>;

const ALARMS = new Set<ApplicationState>(["partly", "in doubt"]);

export function Application({ result: { id, application, robot_serial } }: { result: Calibration }) {
  if (!application) return null;
  const run = station.value?.run;
  const writing = run?.of === id ? run : null;
  const idle = connected.value && !run && operator.value.trim() !== "";
  const alarm = !writing && ALARMS.has(application.state);
  const act = async (send: () => Promise<unknown>) => {
    keepOperator();
    await send();
  };
  return (
    <section class="panel wide application" aria-label={t.result.drives}>
      <h2>{t.result.drives}</h2>
      <p role="status" class={alarm ? "now alarm act" : "now"}>
        {writing ? progress(writing) : statement(application)}
      </p>
      <div class="writes">
        <OperatorField id="apply-operator" />
        <ConfirmedButton
          label={t.result.apply}
          disabled={!idle || application.apply_refused !== null}
          act={() => act(() => apply(id, operator.value.trim(), newKey()))}
        >
          <MotionWarning serial={robot_serial} then={t.result.applyWarning} />
        </ConfirmedButton>
        <ConfirmedButton
          label={t.result.rollBack}
          disabled={!idle || application.rollback_refused !== null}
          act={() => act(() => rollBack(id, operator.value.trim()))}
        >
          <MotionWarning serial={robot_serial} then={t.result.rollBackWarning} />
        </ConfirmedButton>
      </div>
      <JointTable joints={application.joints} />
      <Attempts runs={application.runs} />
      {application.apply_refused && application.rollback_refused && (
        <p class="note">{application.apply_refused}</p>
      )}
    </section>
  );
}

function progress({ walk, step, steps }: Run): string {
  return t.result.step(walk?.title ?? t.shared.waiting, t.shared.stepOf(step ?? 0, steps || "?"));
}

/** What the drives hold, and whether fresh readings agreed. */
export function statement({ state, text, verified }: Pick<Drives, "state" | "text" | "verified">): string {
  const shape = ALARMS.has(state) ? "▲" : verified ? "✓" : "○";
  const checked = state === "applied" ? [verified ? t.result.verified : t.result.notVerified] : [];
  return [shape, text, ...checked].join(" ");
}

function JointTable({ joints }: { joints: Drives["joints"] }) {
  return (
    <table>
      <thead>
        <tr>
          <th scope="col">{t.result.joint}</th>
          <th scope="col">{t.result.identified}</th>
          <th scope="col">{t.result.shift}</th>
          <th scope="col">{t.result.remaining}</th>
          <th scope="col" class="text">
            {t.result.drive}
          </th>
        </tr>
      </thead>
      <tbody>
        {joints.map((joint) => (
          <tr key={joint.joint}>
            <th scope="row">{joint.joint}</th>
            <td>{signed(joint.old_offset_deg, 4)}</td>
            <td>{signed(joint.shift_deg, 4)}</td>
            <td>{signed(joint.new_offset_deg, 4)}</td>
            <td class="text">
              {joint.state === "in doubt" && "▲ "}
              {t.applications[joint.state].name}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Attempts({ runs }: { runs: Drives["runs"] }) {
  if (runs.length === 0) return null;
  return (
    <ul class="attempts">
      {runs.map((one) => (
        <li key={one.id}>
          <Link class="cell" to={`/result/${one.id}`}>
            {t.result.attempt(runKind(one.plan).name, one.id)}
          </Link>
          <Badge run={one} /> <span>{reasonText(one)}</span>
        </li>
      ))}
    </ul>
  );
}
