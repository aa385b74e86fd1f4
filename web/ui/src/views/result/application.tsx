/** The zero offsets of a run in the drives, joint by joint, every attempt, and the rollback. */
import { rollBack } from "../../api";
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
import type { Calibration } from "../../types";

type Drives = NonNullable<Calibration["application"]>;

export function Application({ result: { id, application, robot_serial } }: { result: Calibration }) {
  if (!application) return null;
  const idle = connected.value && !station.value?.run && operator.value.trim() !== "";
  const back = async () => {
    keepOperator();
    await rollBack(id, operator.value.trim());
  };
  return (
    <>
      <JointTable joints={application.joints} />
      <Attempts runs={application.runs} />
      <div class="writes">
        <OperatorField id="apply-operator" />
        <ConfirmedButton
          label={t.result.rollBack}
          disabled={!idle || application.rollback_refused !== null}
          act={back}
        >
          <MotionWarning serial={robot_serial} then={t.result.consequences.roll_back} />
        </ConfirmedButton>
      </div>
      {application.rollback_refused && <p class="note">{application.rollback_refused}</p>}
    </>
  );
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
