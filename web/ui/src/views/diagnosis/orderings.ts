/** By what the residual of a diagnosis may be ordered; the choice lives in the address as `by`. */
import type { ResidualRow } from "../../api";

export interface Series {
  name: string;
  /** mm */
  of: (row: ResidualRow) => number;
}

/** How what is drawn over the dots looks, and the sign that stands for it in the text. */
export const MARKS = [
  { symbol: "circle", sign: "○" },
  { symbol: "diamond", sign: "◇" },
  { symbol: "triangle", sign: "△" },
];

export const isOver = (row: ResidualRow) => Math.abs(row.after_mm) > row.limit_mm;

export interface Ordering {
  id: string;
  text: string;
  /** Of the x axis, with its unit. */
  axis: string;
  /** Null where it was not recorded; `index` is that of the row. */
  along: (row: ResidualRow, index: number) => number | null;
  /** In words, where the axis has few values; they are shown side by side. */
  words?: Record<number, string>;
}

const SIDES = { [-1]: "from above", 0: "unknown", 1: "from below" };
/** How far points of one side are spread, so that they do not cover each other. */
const SPREAD = 0.6;
const spread = (side: number, index: number) => side + SPREAD * (((index * 0.618) % 1) - 0.5);

export const PLACE = "place";

export const ORDERINGS: Ordering[] = [
  { id: "time", text: "Time", axis: "time, s", along: (row) => row.t_s },
  { id: "order", text: "Order", axis: "number of the reading", along: (_, index) => index + 1 },
  { id: PLACE, text: "Place", axis: "x, mm", along: (row) => row.x_mm },
  { id: "joint1", text: "Joint 1", axis: "angle of joint 1, °", along: (row) => row.theta1_deg },
  { id: "joint2", text: "Joint 2", axis: "angle of joint 2, °", along: (row) => row.theta2_deg },
  {
    id: "approach1",
    text: "Approach 1",
    axis: "approach of joint 1",
    along: (row, index) => spread(row.approach1, index),
    words: SIDES,
  },
  {
    id: "approach2",
    text: "Approach 2",
    axis: "approach of joint 2",
    along: (row, index) => spread(row.approach2, index),
    words: SIDES,
  },
  { id: "travel", text: "Travel", axis: "travel of the scale, mm", along: (row) => row.travel_mm },
  { id: "temperature", text: "Temperature", axis: "temperature rise, K", along: (row) => row.temperature_rise_k },
];

/** Those that these readings have. */
export function orderingsOf(rows: ResidualRow[]): Ordering[] {
  return ORDERINGS.filter(({ along }) => rows.some((row, index) => along(row, index) !== null));
}

/** Mean of a residual at each place, in µm. */
export function meansOfPlaces(rows: ResidualRow[], of: (row: ResidualRow) => number) {
  const places = new Map<string, { x: number; y: number; sum: number; count: number }>();
  for (const row of rows) {
    const place = places.get(row.position) ?? { x: row.x_mm, y: row.y_mm, sum: 0, count: 0 };
    place.sum += of(row);
    place.count += 1;
    places.set(row.position, place);
  }
  return [...places.values()].map(({ x, y, sum, count }) => ({ x, y, mean: sum / count }));
}
