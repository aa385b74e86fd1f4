/** The causes that a diagnosis found, by rank, and the dependences of an unexplained residual. */
import { fixed, K, percent, quantity } from "../../format";
import { t } from "../../messages";
import { effectExplanation, effectName, shown } from "../../names";
import { told } from "../../phrase";
import type { Diagnosis, Finding } from "../../types";

/** Whether the effects found are only an attempt. */
export const isTried = ({ verdict, confirmed }: Pick<Diagnosis, "verdict" | "confirmed">) =>
  verdict === "unexplained" || (verdict === "partly_explained" && confirmed === false);

export function Causes({ found }: { found: Diagnosis }) {
  const { findings, verdict } = found;
  const tried = isTried(found);
  return (
    <section class="panel wide causes" aria-label={t.diagnosis.causes}>
      <h2>{title(tried, verdict)}</h2>
      {findings.length === 0 && <p>{t.diagnosis.noEffect}</p>}
      {findings.map((finding, rank) => (
        <Cause key={`${rank} ${effectName(finding)}`} finding={finding} rank={rank + 1} tried={tried} />
      ))}
      {findings.length > 0 && <p class="note">{t.shared.expanded(K)}</p>}
    </section>
  );
}

function title(tried: boolean, verdict: Diagnosis["verdict"]): string {
  if (tried) return t.diagnosis.tried;
  return verdict === "ambiguous" ? t.diagnosis.possible : t.diagnosis.causes;
}

/** Size, share, alternative explanations and remedy of one effect. */
function Cause({ finding, rank, tried }: { finding: Finding; rank: number; tried: boolean }) {
  const { share, probability, alias_set, remedy } = finding;
  const experiment = finding.separating_experiment;
  const parameters = finding.parameters.map(shown);
  return (
    <dl class={probability == null ? "" : "probable"}>
      <div class="effect">
        <dt>{t.diagnosis.effect(rank)}</dt>
        <dd>{effectName(finding)}</dd>
      </div>
      <div>
        <dt>{t.diagnosis.size}</dt>
        {parameters.map(({ name, value, sd, unit }) => (
          <dd key={name}>
            {name} {quantity(value, sd, unit)}
          </dd>
        ))}
      </div>
      <div>
        <dt>{t.diagnosis.share}</dt>
        <dd>{fixed(100 * share, 1)} %</dd>
      </div>
      {probability != null && (
        <div>
          <dt>{t.diagnosis.probability}</dt>
          <dd>{percent(probability)}</dd>
        </div>
      )}
      <div>
        <dt>{t.diagnosis.alternatives}</dt>
        <dd>{t.listed(alias_set.slice(1).map(effectName)) || t.diagnosis.noAlternative}</dd>
      </div>
      <div class="explanation">
        <dd>{effectExplanation(finding.effect)}</dd>
        <dd class="note">
          <details>
            <summary>{t.diagnosis.meaning}</summary>
            <ul>
              {parameters.map(({ name, text }) => (
                <li key={name}>
                  <strong>{name}</strong>: {text}
                </li>
              ))}
            </ul>
          </details>
        </dd>
      </div>
      {!tried && remedy && (
        <div class="remedy">
          <dt>{t.diagnosis.remedy}</dt>
          <dd>
            {told({ text: remedy, said: finding.remedy_said })}
            {experiment &&
              ` ${t.diagnosis.toDistinguish(told({ text: experiment, said: finding.separating_experiment_said }))}`}
          </dd>
        </div>
      )}
    </dl>
  );
}

export function Hints({ found: { hints } }: { found: Diagnosis }) {
  if (hints.length === 0) return null;
  return (
    <section class="panel wide" aria-label={t.diagnosis.hints}>
      <h2>{t.diagnosis.hintsTitle}</h2>
      <ul>
        {hints.map((hint) => (
          <li key={hint.text}>{t.diagnosis.hint(told(hint), fixed(100 * hint.strength, 0))}</li>
        ))}
      </ul>
    </section>
  );
}
