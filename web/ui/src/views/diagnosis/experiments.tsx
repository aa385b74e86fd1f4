/** Experiments that would decide between the explanations, the best one first. */
import { percent } from "../../format";
import { t } from "../../messages";
import { readable } from "../../names";
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
          {ranked.map(({ kind, text, decides }) => (
            <tr key={`${kind} ${text}`}>
              <td class="text">{readable(text)}</td>
              <td class="share">
                <progress value={decides} max={1} aria-hidden="true" />
              </td>
              <td>{percent(decides)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
