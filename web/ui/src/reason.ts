/** Why a run ended as it did: the template of its code, filled with its parameters. */
import { local } from "./format";
import { t } from "./messages";
import { said } from "./messages/said";
import { capital, dependence, inSentence, labelName, readable, withNames } from "./names";
import type { Summary } from "./types";

type Value = string | number;
type Params = Record<string, Value>;

/** The fields of Python's `str.format` that the templates use: `{x}`, `{x:.1f}`, `{x:+.1f}`, `{x:.1g}`. */
const FIELD = /\{(?<name>\w+)(?::(?<sign>\+?)\.(?<digits>\d+)(?<kind>[fg]))?\}/g;

/** Null where a value is missing or is not a number where one has to be. */
export function formatted(template: string, params: Params): string | null {
  let complete = true;
  const fill = (_: string, name: string, sign: string, digits: string | undefined, kind: string) => {
    const value = Object.hasOwn(params, name) ? params[name] : undefined;
    if (value != null && digits === undefined) return String(value);
    if (typeof value === "number" && Number.isFinite(value)) {
      const plus = sign && value >= 0 ? sign : "";
      const text = kind === "f" ? value.toFixed(Number(digits)).replace("-", "−") : general(value, Number(digits) || 1);
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

/** What the parameters of a reason name by identifiers, in words. */
const IN_WORDS: Record<string, (value: string) => string> = {
  causes: (labels) => t.both(labels.split(" and ").map((label) => inSentence(labelName(label)))),
  depends_on: dependence,
};

/** What has no code of its own: a sentence that the station says in English. */
const inEnglishOnly = (text: string) => withNames(said(text));

const inWords = ([name, value]: [string, Value]): [string, Value] => {
  const words = (Object.hasOwn(IN_WORDS, name) && IN_WORDS[name]) || inEnglishOnly;
  return [name, typeof value === "string" ? words(value) : value];
};

/** What a code stands for, without the numbers of one run. */
export function reasonName(code: string): string {
  const templates: Record<string, string> = t.reasons;
  const template = Object.hasOwn(templates, code) ? templates[code] : undefined;
  return template?.replace(FIELD, "…") ?? code.replaceAll("_", " ");
}

type Because = Pick<Summary, "reason"> & Partial<Pick<Summary, "reason_code" | "reason_params">>;

/** The parameters of a reason, with display names in place of identifiers. */
export const paramsInWords = (params: Because["reason_params"]): Params =>
  Object.fromEntries(Object.entries(params ?? {}).map(inWords));

/** In the page's language; runs of older versions, and reasons unknown to the page, have only the sentence. */
export function reasonText({ reason, reason_code, reason_params }: Because): string | null {
  const templates: Record<string, string> = t.reasons;
  const template = reason_code && Object.hasOwn(templates, reason_code) ? templates[reason_code] : undefined;
  const text = template === undefined ? null : formatted(template, paramsInWords(reason_params));
  if (text !== null) return capital(text);
  return reason === null ? null : readable(reason);
}
