import { fixed, signed } from "../../format";
import { finished, station } from "../../live";

/** Reading by reading, the newest first, residual against its limit. */
export function Readings() {
  const readings = (station.value?.run ?? finished.value)?.readings ?? [];
  return (
    <section class="readings">
      <h2>Readings in mm{readings.length > 0 && ` (${readings.length})`}</h2>
      <div class="scroll" tabIndex={0} role="region" aria-label="Readings">
        <table>
          <thead>
            <tr>
              <th scope="col">No.</th>
              <th scope="col" class="text">Position</th>
              <th scope="col">Scale</th>
              <th scope="col">Residual</th>
              <th scope="col">Limit</th>
              <th scope="col" class="text">Verdict</th>
            </tr>
          </thead>
          <tbody>
            {readings.toReversed().map((reading) => (
              <tr key={reading.reading}>
                <td>{reading.reading}</td>
                <td class="text">{reading.position}</td>
                <td>{fixed(reading.scale_mm, 4)}</td>
                <td>{signed(reading.residual_mm, 4)}</td>
                <td>{reading.limit_mm == null ? "–" : `±${fixed(reading.limit_mm, 4)}`}</td>
                <td class="text">
                  <Within residual={reading.residual_mm} limit={reading.limit_mm} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
        {readings.length === 0 && <p class="empty">None yet.</p>}
      </div>
    </section>
  );
}

export function Within({ residual, limit }: { residual: number | null; limit: number | null }) {
  if (residual == null || limit == null) return <>–</>;
  if (Math.abs(residual) <= limit) return <>within</>;
  return <strong class="alarm act">▲ over</strong>;
}
