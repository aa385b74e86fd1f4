/** What the readings could not have shown: the smallest visible size of every effect that was not found. */
import type { Diagnosis } from "../../api";
import { parameterName } from "./causes";

export function Invisible({ found: { invisible } }: { found: Diagnosis }) {
  return (
    <section class="panel wide" aria-label="Not found">
      <h2>What was not found, and how small it could be</h2>
      <p class="note">Smaller effects than these may be there: each size would be found in four of five such walks.</p>
      <table>
        <thead>
          <tr>
            <th scope="col" class="text">
              Effect
            </th>
            <th scope="col">Smallest visible size</th>
            <th scope="col" class="text">
              Of
            </th>
            <th scope="col" class="text">
              Remark
            </th>
          </tr>
        </thead>
        <tbody>
          {invisible.map(({ label, parameter, minimum_detectable, unit, text }) => (
            <tr key={label}>
              <th scope="row" class="text">
                {label.replaceAll("_", " ")}
              </th>
              <td>{minimum_detectable === null ? "–" : `${Number(minimum_detectable.toPrecision(2))} ${unit}`}</td>
              <td class="text">{parameter && unit && parameterName(parameter, unit)}</td>
              <td class="text remark">{text}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
