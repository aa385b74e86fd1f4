/** The errors of the readings, model by model, from the paper's on. */
import type { Diagnosis } from "../../api";
import { fixed } from "../../format";

const UM = 1000;

export function Stages({ found: { stages } }: { found: Diagnosis }) {
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
