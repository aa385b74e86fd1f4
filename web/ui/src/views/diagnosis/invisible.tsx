/** The detection limit of every effect that was not found. */
import { MISSING, significant } from "../../format";
import { t } from "../../messages";
import { labelName, shown } from "../../names";
import { told } from "../../phrase";
import type { Diagnosis } from "../../types";

export function Invisible({ found: { invisible } }: { found: Diagnosis }) {
  return (
    <section aria-label={t.diagnosis.notFound}>
      <p class="note">{t.diagnosis.notFoundNote}</p>
      <table>
        <thead>
          <tr>
            <th scope="col" class="text">
              {t.diagnosis.effectColumn}
            </th>
            <th scope="col">{t.diagnosis.detectionLimit}</th>
            <th scope="col" class="text">
              {t.diagnosis.quantity}
            </th>
            <th scope="col" class="text">
              {t.diagnosis.remark}
            </th>
          </tr>
        </thead>
        <tbody>
          {invisible.map((one) => {
            const { name, limit } = detectionLimit(one);
            return (
              <tr key={one.label}>
                <th scope="row" class="text name">
                  {labelName(one.label)}
                </th>
                <td>{limit}</td>
                <td class="text">{name}</td>
                <td class="text remark">{one.text && told(one)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </section>
  );
}

/** A value with two digits and its unit. */
function detectionLimit({ parameter, minimum_detectable, unit }: Diagnosis["invisible"][number]) {
  if (parameter === null || minimum_detectable === null || unit === null) return { name: "", limit: MISSING };
  const size = shown({ name: parameter, value: minimum_detectable, sd: null, unit });
  return { name: size.name, limit: `${significant(size.value, 2)} ${size.unit}` };
}
