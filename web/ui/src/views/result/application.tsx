/** What the drives hold of a run's zero offsets: write them, take them back. */
import { apply, type Calibration, newKey, rollBack } from "../../api";
import { signed } from "../../format";
import { connected, station } from "../../live";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { Link } from "../../parts/link";
import { Badge } from "../../parts/verdict";

type State = NonNullable<Calibration["application"]>["state"];

const JOINTS: Record<State, string> = {
  unwritten: "old zero",
  applied: "new zero",
  partly: "partly",
  "in doubt": "▲ in doubt",
  "rolled back": "old zero again",
  superseded: "changed since",
};
const ALARMS: Record<string, string> = { partly: "▲", "in doubt": "▲" };

export function Application({ result: { id, application, robot_serial } }: { result: Calibration }) {
  if (!application) return null;
  const run = station.value?.run;
  const writing = run?.of === id ? run : null;
  const idle = connected.value && !run && operator.value.trim() !== "";
  const alarm = ALARMS[application.state];
  const act = async (send: () => Promise<unknown>) => {
    keepOperator();
    await send();
  };
  return (
    <section class="panel wide application" aria-label="Drives">
      <h2>Drives</h2>
      <p role="status" class={`now ${writing ? "" : alarm ? "alarm act" : ""}`}>
        {writing
          ? `▶ ${writing.walk?.title ?? "Waiting to start"}: step ${writing.step ?? 0} of ${writing.steps || "?"}`
          : `${alarm ?? (application.verified ? "✓" : "○")} ${application.text}${
              application.state === "applied" ? (application.verified ? " Verified." : " Not verified.") : ""
            }`}
      </p>
      <div class="writes">
        <p class="field">
          <label for="apply-operator">Operator</label>
          <input
            id="apply-operator"
            value={operator.value}
            maxLength={64}
            spellcheck={false}
            onInput={(event) => (operator.value = event.currentTarget.value)}
          />
        </p>
        <ConfirmedButton
          label="Apply to drives"
          disabled={!idle || application.apply_refused !== null}
          act={() => act(() => apply(id, operator.value.trim(), newKey()))}
        >
          <strong>Robot {robot_serial} will move</strong>, and its drives get new zeros. Nobody within its reach?
        </ConfirmedButton>
        <ConfirmedButton
          label="Roll back"
          disabled={!idle || application.rollback_refused !== null}
          act={() => act(() => rollBack(id, operator.value.trim()))}
        >
          <strong>Robot {robot_serial} will move</strong>, and its drives get their old zeros back. Nobody within its
          reach?
        </ConfirmedButton>
      </div>
      <table>
        <thead>
          <tr>
            <th scope="col">Joint</th>
            <th scope="col">Identified, °</th>
            <th scope="col">Drive moved by, °</th>
            <th scope="col">Left, °</th>
            <th scope="col" class="text">
              Drive
            </th>
          </tr>
        </thead>
        <tbody>
          {application.joints.map((joint) => (
            <tr key={joint.joint}>
              <th scope="row">{joint.joint}</th>
              <td>{signed(joint.old_offset_deg, 4)}</td>
              <td>{signed(joint.shift_deg, 4)}</td>
              <td>{signed(joint.new_offset_deg, 4)}</td>
              <td class="text">{JOINTS[joint.state]}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {application.runs.length > 0 && (
        <ul class="attempts">
          {application.runs.map((one) => (
            <li key={one.id}>
              <Link class="cell" to={`/result/${one.id}`}>
                {one.plan === "apply" ? "Apply" : "Rollback"} {one.id}
              </Link>
              <Badge run={one} /> <span>{one.reason}</span>
            </li>
          ))}
        </ul>
      )}
      {application.apply_refused && application.rollback_refused && <p class="note">{application.apply_refused}</p>}
    </section>
  );
}
