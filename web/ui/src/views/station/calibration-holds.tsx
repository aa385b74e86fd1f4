import { station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";

/** A failed check locks calibrated work; the operator must see it before anything else. */
export function CalibrationHolds() {
  const holds = station.value?.calibration;
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
