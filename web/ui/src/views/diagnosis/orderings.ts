/** By what the residual of a diagnosis can be ordered; the choice lives in the address as `by`. */
import { t } from "../../messages";
import type { ResidualRow } from "../../types";

export interface Series {
  name: string;
  /** mm */
  of: (row: ResidualRow) => number;
}

/** How the series drawn over the dots look, and the sign that stands for each in the legend. */
export const MARKS = [
  { symbol: "circle", sign: "○" },
  { symbol: "diamond", sign: "◇" },
  { symbol: "triangle", sign: "△" },
];

export const isOver = (row: ResidualRow) => Math.abs(row.after_mm) > row.limit_mm;

export interface Ordering {
  id: string;
  name: string;
  /** Of the x axis, with its unit. */
  axis: string;
  /** Null where it was not recorded; `index` is that of the row. */
  along: (row: ResidualRow, index: number) => number | null;
  /** In words, where the axis has few values; they are shown side by side. */
  words?: Record<number, string>;
}

const words = t.diagnosis.orderings;
const SIDES = { [-1]: t.diagnosis.fromAbove, 0: t.diagnosis.unknownSide, 1: t.diagnosis.fromBelow };
/** How far points of one side are spread, so that they do not cover each other. */
const SPREAD = 0.6;
const spread = (side: number, index: number) => side + SPREAD * (((index * 0.618) % 1) - 0.5);

export const POSITION = "position";

export const ORDERINGS: Ordering[] = [
  { id: "time", ...words.time, along: (row) => row.t_s },
  { id: "order", ...words.order, along: (_, index) => index + 1 },
  { id: POSITION, ...words.position, along: (row) => row.x_mm },
  { id: "joint1", ...words.joint1, along: (row) => row.theta1_deg },
  { id: "joint2", ...words.joint2, along: (row) => row.theta2_deg },
  { id: "approach1", ...words.approach1, along: (row, index) => spread(row.approach1, index), words: SIDES },
  { id: "approach2", ...words.approach2, along: (row, index) => spread(row.approach2, index), words: SIDES },
  { id: "travel", ...words.travel, along: (row) => row.travel_mm },
  { id: "temperature", ...words.temperature, along: (row) => row.temperature_rise_k },
];

/** Those that these readings have. */
export function orderingsOf(rows: ResidualRow[]): Ordering[] {
  return ORDERINGS.filter(({ along }) => rows.some((row, index) => along(row, index) !== null));
}

/** Mean of a residual at each position, in mm. */
export function meansOfPositions(rows: ResidualRow[], of: (row: ResidualRow) => number) {
  const positions = new Map<string, { x: number; y: number; sum: number; count: number }>();
  for (const row of rows) {
    const known = positions.get(row.position) ?? { x: row.x_mm, y: row.y_mm, sum: 0, count: 0 };
    known.sum += of(row);
    known.count += 1;
    positions.set(row.position, known);
  }
  return [...positions.values()].map(({ x, y, sum, count }) => ({ x, y, mean: sum / count }));
}

/** Limits differ a little from position to position; the line is drawn at the middle one. */
export function medianLimit(rows: ResidualRow[]): number {
  return rows.map(({ limit_mm }) => limit_mm).sort((a, b) => a - b)[rows.length >> 1]!;
}
