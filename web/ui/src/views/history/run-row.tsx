import { dateTime, expanded, fixed, MISSING, signed } from "../../format";
import { t } from "../../messages";
import { runKind } from "../../names";
import { Link } from "../../parts/link";
import { Badge } from "../../parts/verdict";
import { reasonText } from "../../reason";
import { navigate, query } from "../../router";
import type { Summary } from "../../types";
import { address, comparing, showing } from "./address";

/** One run in the history. */
export function RunRow({ run }: { run: Summary }) {
  return (
    <tr>
      <td>
        <Link class="cell" to={`/result/${run.id}`}>
          {run.id}
        </Link>
      </td>
      <td class="text when">{dateTime(run.started_at ?? run.created_at)}</td>
      <td class="text serial">
        <Link class="cell" to={address(showing(ofRobot(run.robot_serial), "show", "process"))}>
          {run.robot_serial}
        </Link>
      </td>
      <td class="text serial">{run.work_order ?? MISSING}</td>
      <td class="text outcome-cell">
        <span class="badges">
          <Badge run={run} />
          <span>{whatItDid(run)}</span>
        </span>
        {run.reason && <small>{reasonText(run)}</small>}
      </td>
      <td>
        {offset(run, 1)}
        <br />
        {offset(run, 2)}
      </td>
      <td class="text">
        <a
          class="cell"
          href={`/api/v1/calibrations/${run.id}/readings.csv`}
          download
          aria-label={t.history.csvLabel(run.id)}
        >
          {t.history.csv}
        </a>
      </td>
      <td class="text">
        <button
          type="button"
          aria-pressed={[query.value.get("a"), query.value.get("b")].includes(String(run.id))}
          aria-label={t.history.compareLabel(run.id)}
          onClick={() => navigate(address(comparing(query.value, run.id)), { replace: true })}
        >
          {t.history.compareWith}
        </button>
      </td>
    </tr>
  );
}

const ofRobot = (serial: string) => new URLSearchParams({ robot_serial: serial });

/** A calibration is the default; every other kind is named. */
function whatItDid({ kind, of }: Summary): string {
  const { name } = runKind(kind);
  if (of !== null) return t.history.kindOf(name, of);
  return kind === "calibrate" ? "" : name;
}

function offset({ zero_offsets }: Summary, joint: number): string {
  const zero = zero_offsets.find((one) => one.joint === joint);
  return zero ? `${signed(zero.value_deg, 3)} ± ${fixed(expanded(zero.sd_deg), 3)}` : MISSING;
}
