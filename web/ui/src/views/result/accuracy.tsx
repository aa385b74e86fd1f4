import { fixed } from "../../format";
import { t } from "../../messages";
import type { Calibration } from "../../types";

/** What the run promises of positions, beside what was wanted; of a check, how small a shift it finds. */
export function Accuracy({ result: { accuracy, check } }: { result: Calibration }) {
  if (!accuracy && !check) return null;
  return (
    <section class="panel accuracy">
      <h2>{t.result.promised}</h2>
      {accuracy && (
        <>
          <p>{t.result.bound(fixed(accuracy.bound_95_mm, 3), fixed(accuracy.bound_95_model_mm, 3))}</p>
          {accuracy.wanted_mm !== null && (
            <p class={accuracy.reached ? "" : "alarm warn"}>
              {accuracy.reached ? "✓ " : "◆ "}
              {t.result.wanted(fixed(accuracy.wanted_mm, 3))}
            </p>
          )}
          <p class="note">{t.result.stopped(accuracy.stopped_because ?? "")}</p>
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
    </section>
  );
}
