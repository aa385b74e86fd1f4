/** Optional data of a start: the required accuracy, and measurements of other instruments. */
import { signal } from "@preact/signals";
import type { CalibrationBody } from "../../types";

/** As typed; all empty means none. */
export const wishes = {
  accuracy: signal(""),
  joint: signal("1"),
  at: signal(""),
  reads: signal(""),
  sd: signal(""),
  mounting: signal(""),
  mountingSd: signal(""),
};
export type Wish = keyof typeof wishes;

type Said = Pick<CalibrationBody, "until_mm" | "references">;

/** References apply to one run of one robot. */
export function forgetWishes(): void {
  for (const [name, field] of Object.entries(wishes)) field.value = name === "joint" ? "1" : "";
}

/** Names the fields that are incomplete or not numbers; null if the others are valid. */
export function said(): { body: Said; wrong: Wish | null } {
  const body: Said = {};
  const missing = (names: Wish[]) => {
    const given = names.filter((name) => wishes[name].value.trim() !== "");
    return given.length === 0 ? null : (names.find((name) => number(name) === null) ?? null);
  };
  const wrong =
    missing(["accuracy"]) ?? missing(["at", "reads", "sd"]) ?? missing(["mounting", "mountingSd"]);
  const accuracy = number("accuracy");
  if (accuracy !== null) body.until_mm = accuracy;
  const references: NonNullable<Said["references"]> = [];
  const [at, reads, sd] = [number("at"), number("reads"), number("sd")];
  if (at !== null && reads !== null && sd !== null) {
    const joint = wishes.joint.value === "2" ? 2 : 1;
    references.push({ kind: "joint_angle", joint, at_deg: at, reads_deg: reads, sd_deg: sd });
  }
  const [value, valueSd] = [number("mounting"), number("mountingSd")];
  if (value !== null && valueSd !== null) {
    references.push({ kind: "drm_x", value_mm: value, sd_mm: valueSd });
  }
  if (references.length > 0) body.references = references;
  return { body, wrong };
}

function number(name: Wish): number | null {
  const text = wishes[name].value.trim().replace(",", ".");
  const value = Number(text);
  return text === "" || !Number.isFinite(value) ? null : value;
}
