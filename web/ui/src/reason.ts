/** The reason for the end of a run: the template of its code, filled with its parameters. */
import { identified } from "./identifiers";
import { t } from "./messages";
import { said } from "./messages/said";
import { capital, readable, withNames } from "./names";
import { phraseText } from "./phrase";
import { FIELD, formatted, type Params, type Value } from "./template";
import type { Summary } from "./types";

function inWords(name: string, value: NonNullable<Because["reason_params"]>[string]): Value | null {
  if (typeof value === "object") return phraseText(value);
  if (typeof value !== "string") return value;
  // without a code of its own: an English sentence of the station
  return identified(name, value) ?? withNames(said(value));
}

/** The meaning of a code, without the numbers of one run. */
export function reasonName(code: string): string {
  const templates: Record<string, string> = t.reasons;
  const template = Object.hasOwn(templates, code) ? templates[code] : undefined;
  return template?.replace(FIELD, "…") ?? code.replaceAll("_", " ");
}

type Because = Pick<Summary, "reason"> & Partial<Pick<Summary, "reason_code" | "reason_params">>;

/** The parameters of a reason, with display names in place of identifiers; without unknown ones. */
export function paramsInWords(params: Because["reason_params"]): Params {
  const words: Params = {};
  for (const [name, value] of Object.entries(params ?? {})) {
    const said = inWords(name, value);
    if (said !== null) words[name] = said;
  }
  return words;
}

/**
 * In the page's language; for runs of older versions, and reasons unknown to the page, only the English
 * sentence.
 */
export function reasonText({ reason, reason_code, reason_params }: Because): string | null {
  const templates: Record<string, string> = t.reasons;
  const template = reason_code && Object.hasOwn(templates, reason_code) ? templates[reason_code] : undefined;
  const text = template === undefined ? null : formatted(template, paramsInWords(reason_params));
  if (text !== null) return capital(text);
  return reason === null ? null : readable(reason);
}
