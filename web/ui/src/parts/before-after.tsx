/** Errors before and after: of the readings, of fresh readings, and of the position over the workspace. */
import { fixed, micrometres } from "../format";
import { t } from "../messages";
import type { Calibration, PositionError } from "../types";

export function BeforeAfter({ result }: { result: Calibration }) {
  const { before, after, method } = result;
  const diagnosed = method === "diagnosis";
  const words = t.accuracy;
  const um = (mm: number | null | undefined) => micrometres(mm, 2);
  const mm = (size: number | null | undefined) => fixed(size, 3);
  const was: PositionError | null | undefined = before?.predicted_position_error_mm;
  const is: PositionError | null | undefined = after?.predicted_position_error_mm;
  const rows = [
    { text: words.readings, shown: um, before: before?.reading_rms_mm, after: after?.reading_rms_mm },
    {
      text: words.fresh,
      shown: um,
      before: before?.fresh_reading_rms_mm,
      after: after?.fresh_reading_rms_mm,
    },
    { text: words.position, shown: mm, before: was?.rms, after: is?.rms },
    { text: words.largest, shown: mm, before: was?.max, after: is?.max },
    { text: words.bound, shown: mm, before: was?.bound_95, after: is?.bound_95 },
  ];
  return (
    <section class="before-after" aria-label={words.title}>
      <h3>{words.title}</h3>
      <table>
        <thead>
          <tr>
            <td />
            <th scope="col">{diagnosed ? words.without : words.before}</th>
            <th scope="col">{diagnosed ? words.with : words.after}</th>
          </tr>
        </thead>
        <tbody>
          {rows
            .filter((row) => row.before != null || row.after != null)
            .map((row) => (
              <tr key={row.text}>
                <th scope="row" class="text">
                  {row.text}
                </th>
                <td>{row.shown(row.before)}</td>
                <td class="main">{row.shown(row.after)}</td>
              </tr>
            ))}
        </tbody>
      </table>
    </section>
  );
}
