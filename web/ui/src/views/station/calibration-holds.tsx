import { calibrationHolds } from "../../api";
import { station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { useLoaded } from "../../parts/load";

/** A failed check locks work with the calibration; the operator must see it before anything else. */
export function CalibrationHolds() {
  const now = station.value;
  // the feed has it only in its snapshot, and each run that ends may lock or unlock
  const { value } = useLoaded(`${now?.last?.id} ${now?.calibration?.text}`, calibrationHolds).value;
  const holds = value ?? now?.calibration;
  return (
    <section class="panel" aria-label={t.station.locked} hidden={!holds?.locked}>
      {holds?.locked && (
        <>
          <h2>{t.station.locked}</h2>
          <p class="alarm act">
            ▲ {holds.robot_serial}: {said(holds.text)}
          </p>
        </>
      )}
    </section>
  );
}
