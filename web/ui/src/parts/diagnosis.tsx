/** What a diagnostic run found: causes by rank, errors model by model, and what an unexplained rest depends on. */
import { type Calibration, diagnosis, type Diagnosis } from "../api";
import { fixed, measured } from "../format";
import { useLoaded } from "./load";

const K = 2;
const UM = 1000;

export function DiagnosisParts({ result: { id } }: { result: Calibration }) {
  const { value: found, trouble } = useLoaded(`${id}`, () => diagnosis(id)).value;
  if (!found) {
    return (
      <section class="panel wide">
        <p role="status">{trouble ?? "Loading …"}</p>
      </section>
    );
  }
  return (
    <>
      <Causes found={found} />
      {found.hints.length > 0 && <Hints found={found} />}
      <Stages found={found} />
    </>
  );
}

const name = (effect: string, joint: number | null) =>
  effect.replaceAll("_", " ") + (joint === null ? "" : ` of joint ${joint}`);

function Causes({ found: { findings, verdict, confirmed } }: { found: Diagnosis }) {
  const tried = verdict === "unexplained" || (verdict === "partly_explained" && confirmed === false);
  return (
    <section class="panel wide causes" aria-label="Causes">
      <h2>{tried ? "Effects tried, none of them the cause" : "Causes"}</h2>
      {findings.length === 0 && <p>No effect of the catalogue is in the model.</p>}
      {findings.map((one, rank) => (
        <dl key={rank}>
          <div class="effect">
            <dt>Effect {rank + 1}</dt>
            <dd>{name(one.effect, one.joint)}</dd>
          </div>
          <div>
            <dt>Size ± U</dt>
            {one.parameters.map(({ name: parameter, value, sd, unit }) => (
              <dd>
                {parameter.replace(`_${unit}`, "").replaceAll("_", " ")} {measured(value, K * sd)} {unit}
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
                .map(({ effect, joint }) => name(effect, joint))
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

function Hints({ found: { hints } }: { found: Diagnosis }) {
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

function Stages({ found: { stages } }: { found: Diagnosis }) {
  const um = (mm: number | null) => fixed(mm === null ? null : mm * UM, 2);
  return (
    <section class="panel wide" aria-label="Errors">
      <h2>Errors of the readings, in µm</h2>
      <table>
        <thead>
          <tr>
            <th scope="col" class="text">
              Model
            </th>
            <th scope="col">Unknowns</th>
            <th scope="col">Fit, rms</th>
            <th scope="col">Place left out, rms</th>
            <th scope="col">Fresh, rms</th>
            <th scope="col">Fresh, largest</th>
          </tr>
        </thead>
        <tbody>
          {stages.map((stage) => (
            <tr key={stage.model}>
              <th scope="row" class="text">
                {stage.model.replaceAll("_", " ")}
              </th>
              <td>{stage.unknowns}</td>
              <td>{um(stage.fit_rms_mm)}</td>
              <td>{um(stage.holdout_rms_mm)}</td>
              <td class="main">{um(stage.confirm_rms_mm)}</td>
              <td>{um(stage.confirm_max_mm)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
