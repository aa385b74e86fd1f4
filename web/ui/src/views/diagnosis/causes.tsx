/** The causes that a diagnosis found, by rank: size, share, look-alikes, remedy; and what an unexplained rest depends on. */
import type { Diagnosis } from "../../api";
import { fixed, measured } from "../../format";

/** Coverage factor of the expanded uncertainty. */
const K = 2;

export const effectName = (effect: string, joint: number | null) =>
  effect.replaceAll("_", " ") + (joint === null ? "" : ` of joint ${joint}`);

/** Without the unit, which stands behind its value. */
export function parameterName(name: string, unit: string): string {
  const suffix = `_${unit.replace("/", "_per_")}`;
  return name === unit ? "" : (name.endsWith(suffix) ? name.slice(0, -suffix.length) : name).replaceAll("_", " ");
}

export function Causes({ found: { findings, verdict, confirmed } }: { found: Diagnosis }) {
  const tried = verdict === "unexplained" || (verdict === "partly_explained" && confirmed === false);
  return (
    <section class="panel wide causes" aria-label="Causes">
      <h2>{tried ? "Effects tried, none of them the cause" : "Causes"}</h2>
      {findings.length === 0 && <p>No effect of the catalogue is in the model.</p>}
      {findings.map((one, rank) => (
        <dl key={rank}>
          <div class="effect">
            <dt>Effect {rank + 1}</dt>
            <dd>{effectName(one.effect, one.joint)}</dd>
          </div>
          <div>
            <dt>Size ± U</dt>
            {one.parameters.map(({ name: parameter, value, sd, unit }) => (
              <dd>
                {parameterName(parameter, unit)} {measured(value, K * sd)} {unit}
              </dd>
            ))}
          </div>
          <div>
            <dt>Share of the residual</dt>
            <dd>{fixed(100 * one.share, 1)} %</dd>
          </div>
          <div>
            <dt>What else it could be</dt>
            <dd>
              {one.alias_set
                .slice(1)
                .map(({ effect, joint }) => effectName(effect, joint))
                .join(", ") || "nothing else in the catalogue"}
            </dd>
          </div>
          {!tried && (
            <div class="remedy">
              <dt>What to do</dt>
              <dd>
                {one.remedy}
                {one.separating_experiment && ` To tell the look-alikes apart: ${one.separating_experiment}`}
              </dd>
            </div>
          )}
        </dl>
      ))}
      {findings.length > 0 && <p class="note">U is the expanded uncertainty, k = {K}.</p>}
    </section>
  );
}

export function Hints({ found: { hints } }: { found: Diagnosis }) {
  if (hints.length === 0) return null;
  return (
    <section class="panel wide" aria-label="Hints">
      <h2>What the rest depends on</h2>
      <ul>
        {hints.map(({ text, strength }) => (
          <li key={text}>
            {text} ({fixed(100 * strength, 0)} %)
          </li>
        ))}
      </ul>
    </section>
  );
}
