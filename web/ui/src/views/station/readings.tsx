import { fixed, MISSING, micrometres, signedMicrometres } from "../../format";
import { shownRun } from "../../live";
import { t } from "../../messages";

/** Reading by reading, newest first, residual against its limit. */
export function Readings() {
  const readings = shownRun.value?.readings ?? [];
  return (
    <section class="readings">
      <h2>{t.station.readingsTitle(readings.length)}</h2>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.station.readings}>
        <table>
          <thead>
            <tr>
              <th scope="col">{t.station.number}</th>
              <th scope="col" class="text">
                {t.station.position}
              </th>
              <th scope="col">{t.station.scaleMm}</th>
              <th scope="col">{t.station.residualUm}</th>
              <th scope="col">{t.station.limitUm}</th>
              <th scope="col" class="text">
                {t.station.verdict}
              </th>
            </tr>
          </thead>
          <tbody>
            {readings.toReversed().map((reading) => (
              <tr key={reading.reading}>
                <td>{reading.reading}</td>
                <td class="text">{reading.position}</td>
                <td>{fixed(reading.scale_mm, 4)}</td>
                <td>{signedMicrometres(reading.residual_mm, 1)}</td>
                <td>{micrometres(reading.limit_mm, 1)}</td>
                <td class="text">
                  <Within residual={reading.residual_mm} limit={reading.limit_mm} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
        {readings.length === 0 && <p class="empty">{t.station.noReadings}</p>}
      </div>
    </section>
  );
}

function Within({ residual, limit }: { residual: number | null; limit: number | null }) {
  if (residual == null || limit == null) return <>{MISSING}</>;
  if (Math.abs(residual) <= limit) return <>{t.shared.within}</>;
  return <strong class="alarm act">{t.shared.over}</strong>;
}
