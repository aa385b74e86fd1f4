/** The ordering that shows a cause: each effect is clearly visible along the quantity it depends on. */
import type { Diagnosis, EffectAt } from "../../types";
import { type Ordering, POSITION } from "./orderings";

/** By effect of the catalogue; `joint` stands for the effect's own. */
const OF_EFFECT: Record<string, string[]> = {
  backlash: ["approach{joint}"],
  joint_clearance: ["approach{joint}", POSITION],
  gear_cyclic: ["joint{joint}"],
  encoder_eccentricity: ["joint{joint}"],
  transmission_gain: ["joint{joint}"],
  compliance: ["joint{joint}", POSITION],
  count_slip: ["time"],
  lag: ["order"],
  delay: ["order"],
  link_length: [POSITION],
  scale_gain: ["travel"],
  scale_bow: ["travel"],
  scale_cyclic: ["travel"],
  scale_hysteresis: ["travel"],
  drift: ["time"],
  thermal_growth: ["temperature", "time"],
  outliers: ["order"],
  reading_step: ["order"],
};

/** By the quantity that an unnamed error depends on. */
const OF_DEPENDENCE: Record<string, string> = {
  approach: "approach1",
  "approach x place": "approach1",
  place: POSITION,
  reading: "order",
};

/**
 * By the reported cause, otherwise by the most probable explanation, otherwise by the residual's dependence.
 */
export function causeOrdering(
  { findings, explanations = [], hints }: Pick<Diagnosis, "findings" | "explanations" | "hints">,
  orderings: readonly Ordering[],
): Ordering {
  const likely = explanations.toSorted((a, b) => b.probability - a.probability);
  const wanted = [
    ...findings.flatMap(along),
    ...likely.flatMap(({ effects }) => effects.flatMap(along)),
    ...hints.toSorted((a, b) => b.strength - a.strength).map(({ depends_on }) => depending(depends_on)),
  ];
  const found = wanted.map((id) => orderings.find((one) => one.id === id)).find((one) => one !== undefined);
  return found ?? orderings[0]!;
}

function along({ effect, joint, depends_on }: EffectAt): string[] {
  if (depends_on) return [depending(depends_on)];
  const ids = Object.hasOwn(OF_EFFECT, effect) ? OF_EFFECT[effect]! : [];
  return ids.map((id) => id.replace("{joint}", String(joint ?? 1)));
}

/** `theta2` is the angle of joint 2, as `joint2` is. */
const depending = (on: string) => OF_DEPENDENCE[on] ?? on.replace(/^theta/, "joint");
