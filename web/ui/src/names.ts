/** Display names for identifiers of the service. */

import { t } from "./messages";
import { writing } from "./messages/language";
import { said } from "./messages/said";
import type { EffectAt, Interlock, Plan, RunKind } from "./types";

interface Entry {
  name: string;
  text: string;
}

function own<T>(entries: Record<string, T>, id: string): T | undefined {
  return Object.hasOwn(entries, id) ? entries[id] : undefined;
}

/** Fallback for identifiers without a display name. */
const plain = (id: string): Entry => ({ name: capital(id.replaceAll("_", " ")), text: "" });

/** For the beginning of a sentence. */
export const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** For the middle of a sentence; abbreviations keep their capitals, and so do German nouns. */
export const inSentence = (name: string) =>
  !writing.capitals && /^[A-Z][^A-Z]/.test(name) ? name.charAt(0).toLowerCase() + name.slice(1) : name;

const PLACEHOLDERS: Record<string, string> = { n: "(\\d+)", axis: "([xyz])" };
const PLACEHOLDER = /\{(\w+)\}/;

/** The entry of an identifier, also with a number or an axis that the entry leaves open. */
function find<T>(entries: Record<string, T>, id: string): { entry: T; at: string } | undefined {
  const exact = own(entries, id);
  if (exact !== undefined) return { entry: exact, at: "" };
  for (const [key, entry] of Object.entries(entries)) {
    const form = key.replace(PLACEHOLDER, (_, kind: string) => PLACEHOLDERS[kind]!);
    const at = form === key ? null : new RegExp(`^${form}$`).exec(id);
    if (at) return { entry, at: at[1]! };
  }
  return undefined;
}

const filled = (text: string, at: string) => text.replace(PLACEHOLDER, at);

function word(entries: Record<string, string>, id: string): string | undefined {
  const found = find(entries, id);
  return found && filled(found.entry, found.at);
}

const partName = (part: string) => word(t.parts, part) ?? part;

/** The quantity that a residual depends on. */
export const dependence = (on: string) => word(t.dependences, on) ?? on;

const effectEntry = (id: string) => own<Entry>(t.effects, id) ?? plain(id);

export const effectExplanation = (id: string) => effectEntry(id).text;

export function effectName({ effect, joint, part, label, depends_on }: EffectAt): string {
  const { name } = effectEntry(effect);
  if (depends_on) return t.effectAt.dependent(name, dependence(depends_on));
  if (part) return t.effectAt.part(name, partName(part));
  // only the label contains the link or the curve
  if (label) return labelName(label);
  return joint === null ? name : t.effectAt.joint(name, joint);
}

/** `gear_cyclic of joint 1`, `link_length L1`, `thermal_growth of the links`. */
const LABEL =
  /^(?<effect>\w+?)(?<curve> curve)?(?: of joint (?<joint>\d+)| of the (?<part>links|mounting)| (?<link>[Ll]\d+))?$/;

/** The name of an effect for which the service has only the label; unnamed ones have no entry of their own. */
export function labelName(label: string): string {
  const unnamed = word(t.labels, label);
  if (unnamed !== undefined) return unnamed;
  const { effect = label, curve, joint, part, link } = LABEL.exec(label)?.groups ?? {};
  const { name } = effectEntry(effect);
  const whole = curve ? t.effectAt.curve(name) : name;
  if (joint) return t.effectAt.joint(whole, joint);
  const acting = part ?? link;
  return acting ? t.effectAt.part(whole, partName(acting)) : whole;
}

/** Effects by their labels with "and" between them, for the middle of a sentence. */
export const labelsInSentence = (labels: string) =>
  t.both(labels.split(" and ").map((label) => inSentence(labelName(label))));

/**
 * Identifiers of effects within a sentence; with blanks, as in older versions, only for an effect with a
 * place of action.
 */
const MENTIONED = new RegExp(
  Object.keys(t.effects)
    .flatMap((id) => {
      const at = "(?: of joint \\d+| of the (?:links|mounting)| [Ll]\\d+)";
      const acting = `\\b${id.replaceAll("_", "[_ ]")}(?: curve)?${at}\\b`;
      return id.includes("_") ? [acting, `\\b${id}(?: curve)?\\b`] : [acting];
    })
    .join("|"),
  "g",
);

/** Text between backquotes is the identifier of a plan. */
const QUOTED = /`(\w+)`/g;

/** A text of the service with display names in place of identifiers. */
export const withNames = (text: string) =>
  text
    .replace(MENTIONED, (label) => {
      const id = Object.keys(t.effects).find((one) => label.replaceAll(" ", "_").startsWith(one))!;
      return inSentence(labelName(id + label.slice(id.length)));
    })
    .replace(QUOTED, (_, id: string) => planOf(id)?.name ?? id);

/** The same as a sentence. */
export const readable = (text: string) => capital(withNames(said(text)));

/** A model in the sequence from the simplest one: one of three by name, or one with one more effect. */
export function stageName(model: string): string {
  if (model.startsWith("+ ")) return t.added(labelsInSentence(model.slice(2)));
  return (own<Entry>(t.stages, model) ?? plain(model)).name;
}

/** Name of a kind of run. */
export const runKind = (kind: RunKind | (string & {})): Entry => own<Entry>(t.runKinds, kind) ?? plain(kind);

/** The plan of a run; empty for a run without a plan. */
export const planOf = (plan: Plan | (string & {})): Entry | undefined => own<Entry>(t.plans, plan);

export const methodName = (method: string) => own<Entry>(t.methods, method)?.name ?? withNames(method);

/** Name and explanation of a parameter, whatever its number or mount. */
export function parameter(id: string): Entry {
  const [bare = id, mount] = id.split("@");
  const found = find<Entry>(t.parameters, bare);
  const { name, text } = found ? { ...found.entry, name: filled(found.entry.name, found.at) } : plain(bare);
  return { name: mount === undefined ? name : t.mounted(name, mount), text };
}

interface Sized {
  name: string;
  value: number | null;
  sd: number | null;
  unit: string;
}

/** Errors of a reading, which the page states in µm; lengths and travels stay in mm. */
const IN_UM = new Set(["amplitude_mm", "width_mm", "mm_at_100_mm", "mm_per_hour", "mounting_mm", "mm"]);
const UM = 1000;

/** By the unit of the service; it is the same in every language. */
const UNITS: Record<string, string> = {
  deg: "°",
  "deg/kg": "°/kg",
  "um/m": "µm/m",
  "um/m/K": "µm/(m K)",
  "um/K": "µm/K",
  "1/rev": "",
};

/** A parameter as the page shows it: display name, and the page's one unit for its quantity. */
export function shown({ name, value, sd, unit }: Sized): Sized & { text: string } {
  const um = IN_UM.has(name);
  const scaled = (size: number | null) => (um && size !== null ? UM * size : size);
  return {
    ...parameter(name),
    value: scaled(value),
    sd: scaled(sd),
    unit: um ? unit.replace("mm", "µm") : unitName(unit),
  };
}

/** A unit in the page's form. */
export const unitName = (unit: string) => UNITS[unit] ?? unit;

export const deviceName = (name: string) => own<string>(t.deviceNames, name) ?? name;

/** The condition of an interlock; a station of another version may have more of them. */
export const interlockName = ({ id, text, own_text }: Interlock) =>
  own_text ? text : (own<string>(t.interlocks, id) ?? readable(text));

/** Limits of an interlock with their units, for instance "≤ 60 mm". */
export function interlockLimits({ limits }: Interlock): string {
  const { low_c, high_c, ...others } = limits;
  const window = low_c !== undefined && high_c !== undefined ? [`${low_c} … ${high_c}\u00a0°C`] : [];
  const most = Object.entries(others).map(
    ([name, most]) => `≤\u00a0${most}\u00a0${name.endsWith("_deg") ? "°" : "mm"}`,
  );
  return [...window, ...most].join(", ");
}

/** A measure to improve the accuracy, in the page's language; an unknown kind, in English. */
export const adviceText = ({ kind, joint, text }: { kind: string; joint?: number | null; text: string }) =>
  own<(joint: string) => string>(t.result.adviceByKind, kind)?.(String(joint ?? "")) ?? readable(text);
