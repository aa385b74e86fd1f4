/** Display names of what the service calls by an identifier. */
import { t } from "./messages";
import type { EffectAt } from "./types";

interface Entry {
  name: string;
  explanation: string;
}

const entry = (entries: Record<string, Entry>, id: string): Entry | undefined =>
  Object.hasOwn(entries, id) ? entries[id] : undefined;

/** Better than nothing for what has no display name yet. */
const plain = (id: string): Entry => ({ name: id.replaceAll("_", " "), explanation: "" });

const effectEntry = (id: string) => entry(t.effects, id) ?? plain(id);

export const effectExplanation = (id: string) => effectEntry(id).explanation;

export function effectName({ effect, joint }: EffectAt): string {
  const { name } = effectEntry(effect);
  return joint === null ? name : t.effectAt.joint(name, joint);
}

/** `gear_cyclic of joint 1`, `link_length L1`, `thermal_growth of the links`. */
const LABEL =
  /^(?<effect>\w+?)(?<curve> curve)?(?: of joint (?<joint>\d+)|(?<links> of the links)| (?<link>[Ll]\d+))?$/;

/** Of an effect that the service names by its label alone. */
export function labelName(label: string): string {
  const { effect = label, curve, joint, links, link } = LABEL.exec(label)?.groups ?? {};
  const { name } = effectEntry(effect);
  const whole = curve ? t.effectAt.curve(name) : name;
  if (joint) return t.effectAt.joint(whole, joint);
  if (links) return t.effectAt.links(whole);
  // the parameter names the link and the error
  return link ? parameter(link).name : whole;
}

/** A model on the way from the simplest one: one of three by name, or one with one more effect. */
export function stageName(model: string): string {
  if (model.startsWith("+ ")) return t.added(labelName(model.slice(2)));
  return (entry(t.stages, model) ?? plain(model)).name;
}

/** What a run does: its plan, or what else a run can be. */
export const runKind = (plan: string): Entry =>
  entry(t.plans, plan) ?? entry(t.runKinds, plan) ?? plain(plan);

export const methodName = (method: string) => (entry(t.methods, method) ?? plain(method)).name;

/** With the number of a joint, link or wave, or an axis: `L1`, `e1x`, `amplitude_2_deg`, `per_rev_2`, `tool_x`. */
const NUMBERED = [
  /^(dtheta|L|l|alpha|beta|a|b|d)(\d+)()$/,
  /^(tool|origin|base)_([xyz])()$/,
  /^(base_r)([xyz])()$/,
  /^(e)(\d+)([xy])$/,
  /^(amplitude|per_rev)_(\d+)(|_deg)$/,
];

/** Name and explanation of a parameter, whatever its number or mount. */
export function parameter(id: string): Entry {
  const [bare = id, mount] = id.split("@");
  const found = entry(t.parameters, bare) ?? numbered(bare) ?? plain(bare);
  return mount === undefined ? found : { ...found, name: t.numbered(found.name, mount) };
}

function numbered(id: string): Entry | undefined {
  const [, before = "", number = "", after = ""] = NUMBERED.map((form) => form.exec(id)).find(Boolean) ?? [];
  const found = entry(t.parameters, before + after);
  return found && { ...found, name: t.numbered(found.name, number) };
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

/** A parameter as the page shows it: display name, and the page's one unit for its quantity. */
export function shown({ name, value, sd, unit }: Sized): Sized & { explanation: string } {
  const um = IN_UM.has(name);
  const scaled = (size: number | null) => (um && size !== null ? UM * size : size);
  const units: Record<string, string> = t.units;
  return {
    ...parameter(name),
    value: scaled(value),
    sd: scaled(sd),
    unit: um ? unit.replace("mm", "µm") : (units[unit] ?? unit),
  };
}
