/** The explanations of the readings: sets of errors with their probabilities, most probable first. */
import { K, percent, quantity } from "../../format";
import { t } from "../../messages";
import { effectName, inSentence, shown } from "../../names";
import type { Diagnosis, Explanation, Held } from "../../types";

export function Explanations({ found: { explanations = [] } }: { found: Diagnosis }) {
  if (explanations.length === 0) return null;
  const ranked = explanations.toSorted((a, b) => b.probability - a.probability);
  return (
    <section class="panel wide" aria-label={t.diagnosis.explanations}>
      <h2>{t.diagnosis.explanationsTitle}</h2>
      <table class="probabilities">
        <thead>
          <tr>
            <th scope="col" class="text">
              {t.diagnosis.explanationSized}
            </th>
            <th scope="col" class="text" colSpan={2}>
              {t.diagnosis.probability}
            </th>
          </tr>
        </thead>
        <tbody>
          {ranked.map((explanation, rank) => (
            <Row key={rank} explanation={explanation} />
          ))}
        </tbody>
      </table>
      <p class="note">{t.shared.expanded(K)}</p>
    </section>
  );
}

function Row({ explanation: { effects, probability, named } }: { explanation: Explanation }) {
  const size = t.listed(effects.flatMap(sizes));
  return (
    <tr>
      <th scope="row" class="text">
        {effects.length === 0 ? t.diagnosis.noError : errors(effects)}
        {!named && <small> ({t.diagnosis.outsideCatalogue})</small>}
        {size && <small> {size}</small>}
      </th>
      <td class="share">
        <progress value={probability} max={1} aria-hidden="true" />
      </td>
      <td>{percent(probability)}</td>
    </tr>
  );
}

const errors = (effects: Held[]) =>
  t.both(effects.map((effect, k) => (k === 0 ? effectName(effect) : inSentence(effectName(effect)))));

const sizes = ({ parameters = [] }: Held) =>
  parameters
    .map(shown)
    .map(({ name, value, sd, unit }) => `${inSentence(name)} ${quantity(value, sd, unit)}`);
