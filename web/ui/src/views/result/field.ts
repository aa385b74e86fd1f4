/** Geometry of a field of values over a grid: its cells by colour, and its limit line. */
import { colour, type Scale } from "./colours";

/** One row for each y, null if there is no value. */
export type Values = readonly (readonly (number | null)[])[];

export interface Grid {
  x: readonly number[];
  y: readonly number[];
}

const LEVELS = 48;

/** Edges of the cells about the points; the outermost cells end at their points. */
export function edges(points: readonly number[]): number[] {
  const inner = points.slice(1).map((point, k) => (point + points[k]!) / 2);
  return [points[0]!, ...inner, points.at(-1)!];
}

/** One path for each colour, so that a map has a few dozen elements; y grows downwards on the screen. */
export function cells({ x, y }: Grid, values: Values, scale: Scale): { fill: string; d: string }[] {
  const [across, up] = [edges(x), edges(y)];
  const paths = new Map<number, string>();
  for (const [j, row] of values.entries()) {
    for (const [i, value] of row.entries()) {
      if (value === null) continue;
      const level = Math.round(scale.share(value) * LEVELS);
      const [left, right, low, high] = [across[i]!, across[i + 1]!, up[j]!, up[j + 1]!];
      const box = `M${short(left)} ${short(-high)}H${short(right)}V${short(-low)}H${short(left)}Z`;
      paths.set(level, (paths.get(level) ?? "") + box);
    }
  }
  return [...paths].map(([level, d]) => ({ fill: colour(level / LEVELS), d }));
}

const short = (value: number) => Number(value.toFixed(1));

/** Line on which the values, linear along each side of a triangle of grid points, equal the limit. */
export function contour({ x, y }: Grid, values: Values, limit: number): string {
  const lines: string[] = [];
  for (let j = 0; j + 1 < y.length; j++) {
    for (let i = 0; i + 1 < x.length; i++) {
      const corner = (di: number, dj: number) => {
        const value = values[j + dj]![i + di]!;
        return value === null ? null : { x: x[i + di]!, y: -y[j + dj]!, over: value - limit };
      };
      const [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
      // two triangles leave no ambiguity at a saddle
      for (const triangle of [
        [a, b, c],
        [a, c, d],
      ]) {
        const line = crossing(triangle);
        if (line) lines.push(line);
      }
    }
  }
  return lines.join("");
}

type Corner = { x: number; y: number; over: number } | null | undefined;

function crossing(triangle: Corner[]): string | null {
  const [a, b, c] = triangle;
  if (!a || !b || !c) return null;
  const cut = [[a, b] as const, [b, c] as const, [c, a] as const]
    .filter(([one, other]) => one.over > 0 !== other.over > 0)
    .map(([one, other]) => {
      const part = one.over / (one.over - other.over);
      return `${short(one.x + part * (other.x - one.x))} ${short(one.y + part * (other.y - one.y))}`;
    });
  return cut.length === 2 ? `M${cut[0]}L${cut[1]}` : null;
}

/** Whether a limit is met everywhere, nowhere, or in a part, from the existing values. */
export function kept(values: Values, limit: number): "everywhere" | "nowhere" | "partly" {
  const known = values.flat().filter((value) => value !== null);
  if (known.every((value) => value <= limit)) return "everywhere";
  return known.some((value) => value <= limit) ? "partly" : "nowhere";
}

export interface Cell {
  i: number;
  j: number;
}

/** The cell with the largest value. */
export function worst(values: Values): Cell {
  let found = { i: 0, j: 0, value: -1 };
  for (const [j, row] of values.entries()) {
    for (const [i, value] of row.entries())
      if (value !== null && value > found.value) found = { i, j, value };
  }
  return { i: found.i, j: found.j };
}

/** The nearest grid point to a position. */
export function nearest({ x, y }: Grid, at: { x: number; y: number }): Cell {
  const closest = (points: readonly number[], value: number) =>
    points.reduce(
      (best, point, k) => (Math.abs(point - value) < Math.abs(points[best]! - value) ? k : best),
      0,
    );
  return { i: closest(x, at.x), j: closest(y, at.y) };
}

/** One step by an arrow key; null for any other key. */
export function stepped({ x, y }: Grid, { i, j }: Cell, key: string): Cell | null {
  const steps: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
  };
  const step = Object.hasOwn(steps, key) ? steps[key] : undefined;
  if (!step) return null;
  const inside = (value: number, count: number) => Math.min(Math.max(value, 0), count - 1);
  return { i: inside(i + step[0], x.length), j: inside(j + step[1], y.length) };
}
