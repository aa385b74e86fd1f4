/** Texts of the station as a code with parameters, which may be such phrases themselves. */
import { identified } from "./identifiers";
import { t } from "./messages";
import { template } from "./messages/phrases";
import { capital, readable, withNames } from "./names";
import { formatted, type Params, type Value } from "./template";
import type { Phrase } from "./types";

/** The end of a whole sentence, which has a capital. */
const FULL_STOP = /[.。]$/;

/** Null if a text is not loaded yet, unknown to this page, or incomplete. */
export function phraseText(phrase: Phrase): string | null {
  const text = part(phrase);
  return text !== null && FULL_STOP.test(text) ? capital(text) : text;
}

interface Told {
  text: string;
  said: Phrase | null;
}

/**
 * A text of the station in the page's language, as in the middle of a sentence; from an older version, or until the phrases are loaded, its
 * English sentence.
 */
export const toldInside = ({ text, said }: Told) => (said && phraseText(said)) ?? withNames(text);

/** The same for the beginning of one. */
export const told = ({ text, said }: Told) => capital((said && phraseText(said)) ?? readable(text));

function part({ code, params }: Phrase): string | null {
  const form = template(code);
  if (form === null) return null;
  const values: Params = {};
  for (const [name, value] of Object.entries(params)) {
    const said = inWords(name, value);
    if (said === null) return null;
    values[name] = said;
  }
  return formatted(form, values);
}

function inWords(name: string, value: Phrase["params"][string]): Value | null {
  if (Array.isArray(value)) {
    const parts = value.map((one) => inWords(name, one));
    return parts.includes(null) ? null : t.both(parts.map(String));
  }
  if (typeof value === "string") return identified(name, value) ?? value;
  return typeof value === "object" ? part(value) : value;
}
