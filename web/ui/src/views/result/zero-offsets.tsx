import { expanded, fixed, K, MISSING, signed } from "../../format";
import { t } from "../../messages";
import { shown } from "../../names";
import type { Calibration, Quantity } from "../../types";
import { isValid } from "./decision";

/** Each zero offset with its uncertainty, against the tolerance. */
export function ZeroOffsets({ result }: { result: Calibration }) {
  const tolerance = result.zero_offset_tolerance_deg;
  const valid = isValid(result);
  return (
    <>
      {!valid && <p>{t.result.notValidNote}</p>}
      <table class={valid ? "" : "not-valid"}>
        <thead>
          <tr>
            <th scope="col">{t.result.joint}</th>
            <th scope="col">{t.result.value}</th>
            <th scope="col">{t.result.standardUncertainty}</th>
            <th scope="col">{t.result.tolerance}</th>
            <th scope="col" class="text">
              {t.result.verdict}
            </th>
          </tr>
        </thead>
        <tbody>
          {result.zero_offsets.map(({ joint, value_deg, sd_deg }) => (
            <tr key={joint}>
              <th scope="row">{joint}</th>
              <td class="main">
                {signed(value_deg, 4)} ± {fixed(expanded(sd_deg), 4)}
              </td>
              <td>{fixed(sd_deg, 4)}</td>
              <td>{fixed(tolerance, 1)}</td>
              <td class="text">
                {valid ? <Against value={value_deg} limit={tolerance} /> : t.result.notValid}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="note">{t.shared.expanded(K)}</p>
      {result.parameters.length > 0 && <OtherParameters parameters={result.parameters} valid={valid} />}
    </>
  );
}

/** Parameters identified along with the offsets. */
function OtherParameters({ parameters, valid }: { parameters: Quantity[]; valid: boolean }) {
  return (
    <table class={valid ? "others" : "others not-valid"}>
      <thead>
        <tr>
          <th scope="col" class="text">
            {t.result.alsoIdentified}
          </th>
          <th scope="col">{t.result.value}</th>
        </tr>
      </thead>
      <tbody>
        {parameters.map((parameter) => {
          const { name, value, sd, unit } = shown(parameter);
          const text = `${signed(value, 3)} ± ${fixed(expanded(sd), 3)}`;
          return (
            <tr key={parameter.name}>
              <th scope="row" class="text name">
                {name}
              </th>
              <td>{t.result.valueIn(text, unit)}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function Against({ value, limit }: { value: number | null; limit: number | null }) {
  if (value === null || limit === null) return <>{MISSING}</>;
  if (Math.abs(value) <= limit) return <>{t.shared.within}</>;
  return <strong class="alarm warn">{t.shared.outside}</strong>;
}
