/** The visible part of an ordering; the address contains it as `zoom=from,to`. */

export type Span = readonly [number, number];

const FACTOR = 2;
/** Minimum share of the whole; less would show no reading. */
const LEAST = 1 / 200;

/** The part of the whole given in the address; null if that is all or nothing of it. */
export function readSpan(text: string | null, whole: Span): Span | null {
  const [from = Number.NaN, to = Number.NaN] = text?.split(",").map(Number) ?? [];
  const [left, right] = [Math.max(from, whole[0]), Math.min(to, whole[1])];
  const all = left === whole[0] && right === whole[1];
  return left < right && !all ? [left, right] : null;
}

export const writeSpan = (span: Span | null) =>
  span?.map((value) => Number(value.toPrecision(6))).join(",") ?? "";

/** Half the width about a value, inside the whole. */
export function zoomedIn(whole: Span, span: Span | null, about: number): Span {
  const [from, to] = span ?? whole;
  const width = Math.max((to - from) / FACTOR, (whole[1] - whole[0]) * LEAST);
  return inside(whole, about, width);
}

/** Twice the width about the same middle; null if that is all. */
export function zoomedOut(whole: Span, span: Span | null): Span | null {
  if (!span) return null;
  const width = (span[1] - span[0]) * FACTOR;
  return width >= whole[1] - whole[0] ? null : inside(whole, (span[0] + span[1]) / 2, width);
}

/** The same width, moved so that a value is visible. */
export function showing(whole: Span, span: Span | null, value: number): Span | null {
  if (!span || (value >= span[0] && value <= span[1])) return span;
  return inside(whole, value, span[1] - span[0]);
}

function inside(whole: Span, middle: number, width: number): Span {
  const from = Math.min(Math.max(middle - width / 2, whole[0]), whole[1] - width);
  return [from, from + width];
}
