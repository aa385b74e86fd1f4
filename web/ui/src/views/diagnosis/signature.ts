/** The contribution of an effect along an ordering, as a smooth line. */

export type Point = [number, number | null];

const STEPS = 160;
/** Width of the window over which the line is a mean, as a share of the range. */
const WINDOW = 1 / 50;
/** Windows without a reading beyond which the line is broken. */
const GAP = 2;
/**
 * Share of the contribution's sum of squares that a line must account for; otherwise it depends on further
 * quantities.
 */
const ENOUGH = 0.7;

/** Null if the contribution is not a function of this ordering. */
export function signature(along: readonly (number | null)[], sizes: readonly number[]): Point[] | null {
  const known = along.flatMap((x, k) => (x === null ? [] : [{ x, y: sizes[k]! }]));
  if (known.length < 2) return null;
  const xs = known.map(({ x }) => x);
  const [left, right] = [Math.min(...xs), Math.max(...xs)];
  const width = (right - left) * WINDOW;
  if (width === 0) return null;
  const mean = (at: number): number | null => {
    let [sum, weight, nearest] = [0, 0, Number.POSITIVE_INFINITY];
    for (const { x, y } of known) {
      const w = Math.exp(-0.5 * ((x - at) / width) ** 2);
      sum += w * y;
      weight += w;
      nearest = Math.min(nearest, Math.abs(x - at));
    }
    return nearest <= GAP * width ? sum / weight : null;
  };
  const fits = enough(
    known.map(({ y }) => y),
    (k) => mean(xs[k]!) ?? 0,
  );
  if (!fits) return null;
  return Array.from({ length: STEPS + 1 }, (_, k): Point => {
    const x = left + ((right - left) * k) / STEPS;
    return [x, mean(x)];
  });
}

/** For an ordering with few values: a level for each, as wide as the spread of its readings. */
export function levels(sides: readonly number[], sizes: readonly number[], half: number): Point[] | null {
  const means = new Map(
    [...new Set(sides)].map((side) => {
      const own = sizes.filter((_, k) => sides[k] === side);
      return [side, own.reduce((sum, size) => sum + size, 0) / own.length];
    }),
  );
  if (!enough(sizes, (k) => means.get(sides[k]!)!)) return null;
  return [...means]
    .toSorted(([a], [b]) => a - b)
    .flatMap(([side, mean]): Point[] => [
      [side - half, mean],
      [side + half, mean],
      [side + half, null],
    ]);
}

function enough(sizes: readonly number[], line: (k: number) => number): boolean {
  const total = sizes.reduce((sum, y) => sum + y * y, 0);
  const left = sizes.reduce((sum, y, k) => sum + (y - line(k)) ** 2, 0);
  return left <= (1 - ENOUGH) * total;
}
