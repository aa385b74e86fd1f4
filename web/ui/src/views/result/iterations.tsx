import { fixed, signed } from "../../format";
import { t } from "../../messages";
import type { Calibration } from "../../types";

/** The change of each offset, pass by pass. */
export function Iterations({ result: { iterations } }: { result: Calibration }) {
  if (!iterations.length) return null;
  return (
    <>
      <h3>{t.result.passes}</h3>
      <table>
        <thead>
          <tr>
            <th scope="col">{t.result.pass}</th>
            <th scope="col">{t.result.change(1)}</th>
            <th scope="col">{t.result.change(2)}</th>
            <th scope="col">{t.result.total(1)}</th>
            <th scope="col">{t.result.total(2)}</th>
            <th scope="col">{t.result.accuracy}</th>
          </tr>
        </thead>
        <tbody>
          {iterations.map((iteration) => (
            <tr key={iteration.pass}>
              <th scope="row">{iteration.pass}</th>
              <td>{signed(iteration.dtheta1_deg, 4)}</td>
              <td>{signed(iteration.dtheta2_deg, 4)}</td>
              <td>{signed(iteration.total1_deg, 4)}</td>
              <td>{signed(iteration.total2_deg, 4)}</td>
              <td>{fixed(iteration.mu_deg, 4)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </>
  );
}
