import { fixed } from "../../format";
import { t } from "../../messages";
import { told } from "../../phrase";
import type { Calibration } from "../../types";

/** The combination of parameters that the readings determine least, and the remedies. */
export function WeakDirection({ result: { weak_direction: weak } }: { result: Calibration }) {
  if (!weak?.text) return null;
  return (
    <>
      <h3>{t.result.weakDirection}</h3>
      <p>
        {told(weak)}
        {weak.sd_deg !== null && ` (${t.shared.standard(`${fixed(weak.sd_deg, 3)}°`)})`}
      </p>
      {weak.remedy && (
        <p class="note">{t.result.remedy(told({ text: weak.remedy, said: weak.remedy_said }))}</p>
      )}
    </>
  );
}
