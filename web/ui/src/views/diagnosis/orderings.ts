/** The possible orderings of a diagnosis's residual; the address contains the choice as `by`. */
import { t } from "../../messages";
import type { ResidualRow } from "../../types";
import { levels, type Point, signature } from "./signature";

export interface Series {
  name: string;
  /** mm */
  of: (row: ResidualRow) => number;
}

/** Styles of the series drawn over the dots, and their signs in the legend. */
export const MARKS = [
  { symbol: "circle", sign: "○" },
  { symbol: "diamond", sign: "◇" },
  { symbol: "triangle", sign: "△" },
];

export const isOver = (row: ResidualRow) => Math.abs(row.after_mm) > row.limit_mm;

export interface Ordering {
  id: string;
  name: string;
  /** Label of the x axis, with its unit. */
  axis: string;
  /** Null if it was not recorded; `index` is that of the row. */
  along: (row: ResidualRow, index: number) => number | null;
  /** For an axis of few values: each value in words, and that of a reading; they are side by side. */
  words?: Record<number, string>;
  side?: (row: ResidualRow) => number;
}

const words = t.diagnosis.orderings;
const SIDES = { [-1]: t.diagnosis.fromAbove, 0: t.diagnosis.unknownSide, 1: t.diagnosis.fromBelow };
/** Spread of the points of one side, so that they do not cover each other. */
export const SPREAD = 0.6;
const spread = (side: number, index: number) => side + SPREAD * (((index * 0.618) % 1) - 0.5);

export const POSITION = "position";

const sides = (id: "approach1" | "approach2", side: (row: ResidualRow) => number): Ordering => ({
  id,
  ...words[id],
  along: (row, index) => spread(side(row), index),
  words: SIDES,
  side,
});

export const ORDERINGS: Ordering[] = [
  { id: "time", ...words.time, along: (row) => row.t_s },
  { id: "order", ...words.order, along: (_, index) => index + 1 },
  { id: POSITION, ...words.position, along: (row) => row.x_mm },
  { id: "joint1", ...words.joint1, along: (row) => row.theta1_deg },
  { id: "joint2", ...words.joint2, along: (row) => row.theta2_deg },
  sides("approach1", (row) => row.approach1),
  sides("approach2", (row) => row.approach2),
  { id: "travel", ...words.travel, along: (row) => row.travel_mm },
  { id: "temperature", ...words.temperature, along: (row) => row.temperature_rise_k },
];

/** The orderings that these readings support. */
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

/**
 * Value of each reading along an ordering, from the smallest to the largest; readings without one are
 * omitted.
 */
export function inOrder(rows: ResidualRow[], { along }: Ordering): { index: number; at: number }[] {
  return rows
    .map((row, index) => ({ index, at: along(row, index) }))
    .filter((one): one is { index: number; at: number } => one.at !== null)
    .sort((a, b) => a.at - b.at);
}

/** The contribution of an effect, as a line along an ordering; null if it depends on further quantities. */
export function contributionLine(rows: ResidualRow[], ordering: Ordering, { of }: Series): Point[] | null {
  const sizes = rows.map(of);
  const { side } = ordering;
  return side
    ? levels(rows.map(side), sizes, SPREAD / 2)
    : signature(
        rows.map((row, index) => ordering.along(row, index)),
        sizes,
      );
}

/** Limits differ slightly from position to position; the line is drawn at the median. */
export function medianLimit(rows: ResidualRow[]): number {
  return rows.map(({ limit_mm }) => limit_mm).sort((a, b) => a - b)[rows.length >> 1]!;
}
