/** The causes that a diagnosis found, by rank, and what an unexplained residual depends on. */
import { expanded, fixed, K, measured } from "../../format";
import { t } from "../../messages";
import { effectExplanation, effectName, shown } from "../../names";
import type { Diagnosis } from "../../types";

type Finding = Diagnosis["findings"][number];

export function Causes({ found: { findings, verdict, confirmed } }: { found: Diagnosis }) {
  const tried = verdict === "unexplained" || (verdict === "partly_explained" && confirmed === false);
  return (
    <section class="panel wide causes" aria-label={t.diagnosis.causes}>
      <h2>{tried ? t.diagnosis.tried : t.diagnosis.causes}</h2>
      {findings.length === 0 && <p>{t.diagnosis.noEffect}</p>}
      {findings.map((finding, rank) => (
        <Cause key={`${rank} ${effectName(finding)}`} finding={finding} rank={rank + 1} tried={tried} />
      ))}
      {findings.length > 0 && <p class="note">{t.shared.expanded(K)}</p>}
    </section>
  );
}

/** Size, share, alternative explanations and remedy of one effect. */
function Cause({ finding, rank, tried }: { finding: Finding; rank: number; tried: boolean }) {
  const { share, alias_set, remedy, separating_experiment } = finding;
  const parameters = finding.parameters.map(shown);
  return (
    <dl>
      <div class="effect">
        <dt>{t.diagnosis.effect(rank)}</dt>
        <dd>{effectName(finding)}</dd>
      </div>
      <div>
        <dt>{t.diagnosis.size}</dt>
        {parameters.map(({ name, value, sd, unit }) => (
          <dd key={name}>
            {name} {measured(value, expanded(sd))} {unit}
          </dd>
        ))}
      </div>
      <div>
        <dt>{t.diagnosis.share}</dt>
        <dd>{fixed(100 * share, 1)} %</dd>
      </div>
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
              {parameters.map(({ name, explanation }) => (
                <li key={name}>
                  <strong>{name}</strong>: {explanation}
                </li>
              ))}
            </ul>
          </details>
        </dd>
      </div>
      {!tried && (
        <div class="remedy">
          <dt>{t.diagnosis.remedy}</dt>
          <dd>
            {remedy}
            {separating_experiment && ` ${t.diagnosis.toDistinguish(separating_experiment)}`}
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
        {hints.map(({ text, strength }) => (
          <li key={text}>{t.diagnosis.hint(text, fixed(100 * strength, 0))}</li>
        ))}
      </ul>
    </section>
  );
}
