import { duration, fixed } from "../../format";
import { t } from "../../messages";
import { adviceText } from "../../names";
import { toldInside } from "../../phrase";
import type { Calibration } from "../../types";

type Reached = NonNullable<Calibration["accuracy"]>;

/**
 * The predicted position accuracy of a run, with the required one; for a check, the smallest detectable
 * shift.
 */
export function Accuracy({ result: { accuracy, check, advice } }: { result: Calibration }) {
  if (!accuracy && !check) return null;
  return (
    <>
      {accuracy && (
        <>
          <p>{t.result.bound(fixed(accuracy.bound_95_mm, 3), fixed(accuracy.bound_95_model_mm, 3))}</p>
          {accuracy.wanted_mm !== null && (
            <p class={accuracy.reached ? "" : "alarm warn"}>
              {accuracy.reached ? "✓ " : "◆ "}
              {t.result.wanted(fixed(accuracy.wanted_mm, 3))}
            </p>
          )}
          <p class="note">{t.result.stopped(stopReason(accuracy))}</p>
          <AdviceTable advice={advice} />
        </>
      )}
      {check && (
        <p>
          {t.result.smallestShift(
            fixed(check.smallest_shift_deg, 4),
            check.blind,
            fixed(check.blind_shift_deg, 4),
          )}
        </p>
      )}
    </>
  );
}

const SECONDS = 60;

/** Why no further readings were taken. */
const stopReason = ({ stopped_because: text, stopped_because_said: said }: Reached) =>
  text === null ? "" : toldInside({ text, said });

/** Measures to improve the accuracy, with gain and duration. */
function AdviceTable({ advice }: { advice: Calibration["advice"] }) {
  if (advice.length === 0) return null;
  return (
    <table>
      <thead>
        <tr>
          <th scope="col" class="text">
            {t.result.advice}
          </th>
          <th scope="col">{t.result.gain}</th>
          <th scope="col">{t.result.time}</th>
        </tr>
      </thead>
      <tbody>
        {advice.map(({ kind, joint, text, gain_mm, minutes }) => (
          <tr key={`${kind} ${text}`}>
            <th scope="row" class="text">
              {adviceText({ kind, joint: joint ?? null, text })}
            </th>
            <td>{fixed(gain_mm, 3)}</td>
            <td>{duration(SECONDS * minutes)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
