/** Typed or pasted taught joint positions: one per line, its name, then both angles in degrees. */
import type { TaughtPosition, TranslatedPosition } from "../../types";

const HEAD = /^position\b/i;

/** The positions, or the number of the first invalid line. A line with column names may come first. */
export function taughtOf(text: string): { positions: TaughtPosition[]; wrong: number | null } {
  const positions: TaughtPosition[] = [];
  for (const [k, line] of text.split("\n").entries()) {
    if (line.trim() === "" || (positions.length === 0 && HEAD.test(line.trim()))) continue;
    const [position = "", first = "", second = "", ...more] = line.trim().split(/[\s;,]+/);
    const [theta1_deg, theta2_deg] = [Number(first), Number(second)];
    const numbers = first !== "" && second !== "" && Number.isFinite(theta1_deg + theta2_deg);
    if (!numbers || more.length > 0) return { positions: [], wrong: k + 1 };
    positions.push({ position, theta1_deg, theta2_deg });
  }
  return { positions, wrong: null };
}

/** As `station translate` writes them. */
export const translatedCsv = (positions: readonly TranslatedPosition[]) =>
  [
    "position,theta1_deg,theta2_deg,u95_mm,within_limits",
    ...positions.map(({ position, theta1_deg, theta2_deg, u95_mm, within_limits }) =>
      [position, theta1_deg, theta2_deg, u95_mm ?? "", within_limits].join(","),
    ),
    "",
  ].join("\n");
