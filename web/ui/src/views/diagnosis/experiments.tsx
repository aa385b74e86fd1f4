/** Experiments that would decide between the explanations, the best one first. */
import { percent } from "../../format";
import { t } from "../../messages";
import { told } from "../../phrase";
import type { Diagnosis } from "../../types";

export function Experiments({ found: { experiments = [] } }: { found: Diagnosis }) {
  if (experiments.length === 0) return null;
  const ranked = experiments.toSorted((a, b) => b.decides - a.decides);
  return (
    <section class="panel wide" aria-label={t.diagnosis.experiments}>
      <h2>{t.diagnosis.experimentsTitle}</h2>
      <table class="probabilities">
        <thead>
          <tr>
            <th scope="col" class="text">
              {t.diagnosis.experiment}
            </th>
            <th scope="col" class="text" colSpan={2}>
              {t.diagnosis.decides}
            </th>
          </tr>
        </thead>
        <tbody>
          {ranked.map((one) => (
            <tr key={`${one.kind} ${one.text}`}>
              <td class="text">{told(one)}</td>
              <td class="share">
                <progress value={one.decides} max={1} aria-hidden="true" />
              </td>
              <td>{percent(one.decides)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
