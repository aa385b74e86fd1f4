/** Typed or pasted taught joint positions: one per line, its name, then both angles in degrees. */
import type { TaughtPosition, TranslatedPosition } from "../../types";

const HEAD = /^position\b/i;
/** Column names of a CSV file, or joint targets of a program in KRL or RAPID: the station reads those. */
const FILE = /\btheta1_|\{[^}]*\bA[12]\s|\bjointtarget\b|\bMoveAbsJ\b/i;
const DECIMAL_COMMA = /^([+-]?\d+),(\d+)$/;

export const isFile = (text: string) => FILE.test(text);

/** The positions, or the number of the first invalid line. A line with column names may come first. */
export function taughtOf(text: string): { positions: TaughtPosition[]; wrong: number | null } {
  const positions: TaughtPosition[] = [];
  for (const [k, line] of text.split("\n").entries()) {
    if (line.trim() === "" || (positions.length === 0 && HEAD.test(line.trim()))) continue;
    const [position = "", first = "", second = "", ...more] = cellsOf(line.trim());
    const [theta1_deg, theta2_deg] = [Number(first), Number(second)];
    const numbers = first !== "" && second !== "" && Number.isFinite(theta1_deg + theta2_deg);
    if (!numbers || more.length > 0) return { positions: [], wrong: k + 1 };
    positions.push({ position, theta1_deg, theta2_deg });
  }
  return { positions, wrong: null };
}

/** Where semicolons or spaces separate, a comma may be the decimal sign. */
function cellsOf(line: string): string[] {
  const cells = line.split(line.includes(";") ? /\s*;\s*/ : /\s+/).filter((cell) => cell !== "");
  const inner = cells.slice(1);
  if (inner.length === 2 && inner.every((cell) => /^[^,]+(,\d+)?$/.test(cell))) {
    return [cells[0]!, ...inner.map((cell) => cell.replace(DECIMAL_COMMA, "$1.$2"))];
  }
  return line.split(/[\s;,]+/);
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
