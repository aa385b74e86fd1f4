/** The errors of the readings, model by model, from the simplest one on. */
import { micrometres } from "../../format";
import { t } from "../../messages";
import { stageName } from "../../names";
import type { Diagnosis } from "../../types";

export function Stages({ found: { stages } }: { found: Diagnosis }) {
  const um = (mm: number | null) => micrometres(mm, 2);
  return (
    <section aria-label={t.diagnosis.errors}>
      <table>
        <thead>
          <tr>
            <th scope="col" class="text">
              {t.diagnosis.model}
            </th>
            <th scope="col">{t.diagnosis.unknowns}</th>
            <th scope="col">{t.diagnosis.fit}</th>
            <th scope="col">{t.diagnosis.leftOut}</th>
            <th scope="col">{t.diagnosis.fresh}</th>
            <th scope="col">{t.diagnosis.freshLargest}</th>
          </tr>
        </thead>
        <tbody>
          {stages.map((stage, number) => (
            <tr key={`${number} ${stage.model}`}>
              <th scope="row" class="text name">
                {stageName(stage.model)}
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
