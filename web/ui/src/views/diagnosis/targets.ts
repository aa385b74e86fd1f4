/** Typed or pasted targets: one per line, x and y in mm, then the side of approach of each joint. */
import type { Solution, Target } from "../../types";

/** One side alone is not valid: both, or neither. */
const COUNTS = new Set([2, 4]);

/** The targets, or the number of the first invalid line. */
export function targetsOf(text: string): { targets: Target[]; wrong: number | null } {
  const targets: Target[] = [];
  for (const [k, line] of text.split("\n").entries()) {
    if (line.trim() === "") continue;
    const values = line
      .trim()
      .split(/[\s;,\t]+/)
      .map(Number);
    const [x, y, approach1 = 0, approach2 = 0] = values;
    const sides = [approach1, approach2].every((side) => side === -1 || side === 0 || side === 1);
    if (!COUNTS.has(values.length) || !values.every(Number.isFinite) || !sides)
      return { targets: [], wrong: k + 1 };
    targets.push({
      x_mm: x!,
      y_mm: y!,
      approach1: approach1 as Target["approach1"],
      approach2: approach2 as Target["approach2"],
    });
  }
  return { targets, wrong: null };
}

/** As `station solve --csv` writes them. */
export const commandsCsv = (targets: Target[], { commands }: Solution) =>
  [
    "x_mm,y_mm,theta1_deg,theta2_deg",
    ...commands.map(({ theta1_deg, theta2_deg }, k) =>
      [targets[k]!.x_mm, targets[k]!.y_mm, theta1_deg, theta2_deg].join(","),
    ),
    "",
  ].join("\n");
