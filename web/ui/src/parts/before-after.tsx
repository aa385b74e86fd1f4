/** What became of the errors: of the readings, of fresh ones, of the position over the workspace. */
import type { Calibration } from "../api";
import { fixed } from "../format";

export function BeforeAfter({ result, wide }: { result: Calibration; wide?: boolean }) {
  const { before, after, method } = result;
  const diagnosed = method === "diagnosis";
  const rows = [
    { text: "Readings, rms", digits: 4, before: before?.reading_rms_mm, after: after?.reading_rms_mm },
    {
      text: "Fresh readings, rms",
      digits: 4,
      before: before?.fresh_reading_rms_mm,
      after: after?.fresh_reading_rms_mm,
    },
    {
      text: "Predicted position error, rms",
      digits: 3,
      before: before?.predicted_position_error_mm?.rms,
      after: after?.predicted_position_error_mm?.rms,
    },
    {
      text: "Predicted position error, largest",
      digits: 3,
      before: before?.predicted_position_error_mm?.max,
      after: after?.predicted_position_error_mm?.max,
    },
  ];
  return (
    <section class={wide ? "panel wide" : "panel"} aria-label="Before and after">
      <h2>Before and after, in mm</h2>
      <table>
        <thead>
          <tr>
            <td />
            <th scope="col">{diagnosed ? "Without the effects" : "Before"}</th>
            <th scope="col">{diagnosed ? "With them" : "After"}</th>
          </tr>
        </thead>
        <tbody>
          {rows.filter(({ before, after }) => before != null || after != null).map((row) => (
            <tr>
              <th scope="row" class="text">
                {row.text}
              </th>
              <td>{fixed(row.before, row.digits)}</td>
              <td class="main">{fixed(row.after, row.digits)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
