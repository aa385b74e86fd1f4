/** Texts of the station as a code with parameters, which may be such phrases themselves. */
import { t } from "./messages";
import { template } from "./messages/phrases";
import { formatted, type Params, type Value } from "./template";
import type { Phrase } from "./types";

/** Null if a text is not loaded yet, unknown to this page, or incomplete. */
export function phraseText(phrase: Phrase): string | null {
  const text = part(phrase);
  return text === null ? null : text.charAt(0).toUpperCase() + text.slice(1);
}

function part({ code, params }: Phrase): string | null {
  const form = template(code);
  if (form === null) return null;
  const values: Params = {};
  for (const [name, value] of Object.entries(params)) {
    const said = inWords(value);
    if (said === null) return null;
    values[name] = said;
  }
  return formatted(form, values);
}

function inWords(value: Phrase["params"][string]): Value | null {
  if (Array.isArray(value)) {
    const parts = value.map(inWords);
    return parts.includes(null) ? null : t.both(parts.map(String));
  }
  return typeof value === "object" ? part(value) : value;
}
