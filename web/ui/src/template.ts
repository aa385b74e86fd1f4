/** Templates filled as by Python's `str.format`. */
import { local } from "./format";

export type Value = string | number;
export type Params = Record<string, Value>;

/** The fields of Python's `str.format` that the templates use: `{x}`, `{x:.1f}`, `{x:+.1f}`, `{x:.1g}`. */
export const FIELD = /\{(?<name>\w+)(?::(?<sign>\+?)\.(?<digits>\d+)(?<kind>[fg]))?\}/g;

/** Null if a value is missing or is not a number where one is required. */
export function formatted(template: string, params: Params): string | null {
  let complete = true;
  const fill = (_: string, name: string, sign: string, digits: string | undefined, kind: string) => {
    const value = Object.hasOwn(params, name) ? params[name] : undefined;
    if (value != null && digits === undefined) return String(value);
    if (typeof value === "number" && Number.isFinite(value)) {
      const plus = sign && value >= 0 ? sign : "";
      const text =
        kind === "f" ? value.toFixed(Number(digits)).replace("-", "−") : general(value, Number(digits) || 1);
      return plus + local(text);
    }
    complete = false;
    return "";
  };
  const text = template.replace(FIELD, fill);
  return complete ? text : null;
}

/** As Python's `g`: `digits` significant ones, with an exponent where the number is small or large. */
function general(value: number, digits: number): string {
  const [mantissa = "", exponent = "0"] = value.toExponential(digits - 1).split("e");
  const power = Number(exponent);
  if (power >= -4 && power < digits) return trimmed(value.toFixed(digits - 1 - power));
  return `${trimmed(mantissa)}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}

const trimmed = (number: string) => (number.includes(".") ? number.replace(/\.?0+$/, "") : number);
