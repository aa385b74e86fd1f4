/**
 * The residual along an ordering: readings as dots, contributions of effects as lines, and the selected
 * reading.
 */
import { LineChart, ScatterChart } from "echarts/charts";
import { GridComponent } from "echarts/components";
import { use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import { micrometres } from "../../format";
import { t } from "../../messages";
import { type Chart, DARK, GREY, put, RED, xAxis, yAxis } from "../../parts/drawing";
import type { ResidualRow } from "../../types";
import {
  contributionLine,
  isOver,
  MARKS,
  meansOfPositions,
  type Ordering,
  POSITION,
  type Series,
} from "./orderings";
import type { Span } from "./zoom";

use([LineChart, ScatterChart, GridComponent, SVGRenderer]);

const UM = 1000;
const LARGEST_MARK = 34;
const ROUND_MM = 50;
/** Radius of a tap, in pixels: the accuracy of a gloved finger. */
const REACH = 40;

/** The content of one chart. */
export interface Shown {
  rows: ResidualRow[];
  ordering: Ordering;
  /** The first as dots, the others over it. */
  series: [Series, ...Series[]];
  /** Drawn dashed where given. */
  limit_mm: number | null;
  span: Span | null;
  /** Index of the selected row. */
  cursor: number | null;
}

const optionOf = (shown: Shown) =>
  shown.ordering.id === POSITION ? positionsOption(shown) : orderingOption(shown);

/** @param read index of the row next to a tap */
export function draw(
  place: HTMLElement,
  shown: Shown,
  read: (index: number) => void,
): Pick<Chart, "picture" | "remove"> & { show: (shown: Shown) => void } {
  let now = shown;
  const chart = put(place, optionOf(shown), (at, toPixel) => {
    const found = nextTo(at, spots(now).map(toPixel));
    if (found !== null) read(found);
  });
  return {
    ...chart,
    show: (next) => {
      now = next;
      chart.set(optionOf(next));
    },
  };
}

/** Position of each row, in the units of the axes. */
function spots({ rows, ordering, series }: Shown): [number, number][] {
  if (ordering.id === POSITION) return rows.map(({ x_mm, y_mm }) => [x_mm, y_mm]);
  return rows.map((row, index) => [ordering.along(row, index) ?? Number.NaN, UM * series[0].of(row)]);
}

/** Index of the nearest of `spots`, in pixels; null if none is near. */
export function nextTo([x, y]: [number, number], all: [number, number][]): number | null {
  const distances = all.map(([a, b]) => Math.hypot(a - x, b - y));
  const nearest = distances.reduce((best, d, k) => (d < (distances[best] ?? REACH) ? k : best), -1);
  return nearest >= 0 && distances[nearest]! <= REACH ? nearest : null;
}

export function orderingOption({
  rows,
  ordering,
  series: [dots, ...effects],
  limit_mm,
  span,
  cursor,
}: Shown) {
  const along = rows.map((row, index) => ordering.along(row, index));
  const points = ({ of }: Series) => rows.map((row, index) => [along[index], UM * of(row)]);
  const known = along.filter((value) => value !== null);
  const [left, right] = ordering.words ? [-1.5, 1.5] : [Math.min(...known), Math.max(...known)];
  const over = ({ dataIndex }: { dataIndex: number }) => limit_mm !== null && isOver(rows[dataIndex]!);
  const limits = limit_mm === null ? [] : [UM * limit_mm, -UM * limit_mm];
  const read = cursor === null ? [] : [points(dots)[cursor]!];
  return {
    xAxis: {
      ...xAxis,
      name: ordering.axis,
      ...(ordering.words ? sidesAxis(ordering.words, known) : span && { min: span[0], max: span[1] }),
    },
    yAxis: { ...yAxis, name: t.diagnosis.micrometre },
    series: [
      ...limits.map((limit) => ({
        type: "line",
        data: [
          [left, limit],
          [right, limit],
        ],
        symbol: "none",
        silent: true,
        lineStyle: { color: GREY, type: "dashed", width: 1.5 },
      })),
      {
        type: "scatter",
        silent: true,
        symbol: (_: unknown, point: { dataIndex: number }) => (over(point) ? "diamond" : "circle"),
        symbolSize: (_: unknown, point: { dataIndex: number }) => (over(point) ? 12 : 6),
        itemStyle: { color: (point: { dataIndex: number }) => (over(point) ? RED : DARK) },
        data: points(dots),
      },
      ...effects.map((effect, k) => {
        const line = contributionLine(rows, ordering, effect);
        return line === null ? marks(points(effect), k) : signatureLine(line, k);
      }),
      ring(read),
    ],
  };
}

const LINES = ["solid", [10, 5], [2, 4]];

const signatureLine = (line: [number, number | null][], k: number) => ({
  type: "line",
  data: line.map(([x, mm]) => [x, mm === null ? null : UM * mm]),
  symbol: "none",
  silent: true,
  connectNulls: false,
  lineStyle: { color: GREY, width: 3, type: LINES[k % LINES.length] },
});

const marks = (data: (number | null | undefined)[][], k: number) => ({
  type: "scatter",
  silent: true,
  symbol: MARKS[k % MARKS.length]!.symbol,
  symbolSize: 11,
  itemStyle: { color: "transparent", borderColor: GREY, borderWidth: 1.5 },
  data,
});

/** Drawn around the selected reading. */
const ring = (data: (number | null | undefined)[][]) => ({
  type: "scatter",
  silent: true,
  symbolSize: 20,
  itemStyle: { color: "transparent", borderColor: DARK, borderWidth: 3 },
  data,
});

/** An axis of few values in words; the one for "unknown" only if it occurs. */
function sidesAxis(words: Record<number, string>, known: number[]) {
  const customValues = known.some((value) => Math.abs(value) < 0.5) ? [-1, 0, 1] : [-1, 1];
  const formatter = (value: number) => words[value] ?? "";
  return {
    min: -1.5,
    max: 1.5,
    splitLine: { show: false },
    axisLabel: { ...xAxis.axisLabel, customValues, formatter },
    axisTick: { customValues },
  };
}

/** The mean of each position over the workspace: area by size, filled where positive, hollow where negative. */
export function positionsOption({ rows, series: [{ of }], cursor }: Shown) {
  const means = meansOfPositions(rows, of);
  const largest = Math.max(...means.map(({ mean }) => Math.abs(mean))) || 1;
  const [left, right] = ends(means.map(({ x }) => x));
  const [bottom, top] = ends(means.map(({ y }) => y));
  const read = cursor === null ? [] : [[rows[cursor]!.x_mm, rows[cursor]!.y_mm]];
  return {
    xAxis: { ...xAxis, name: t.diagnosis.xAxisMean(micrometres(largest, 1)), min: left, max: right },
    yAxis: { ...yAxis, name: t.diagnosis.yAxis, min: bottom, max: top },
    series: [
      {
        type: "scatter",
        silent: true,
        itemStyle: {
          color: ({ value: [, , mean] }: { value: number[] }) => (mean! > 0 ? DARK : "transparent"),
          borderColor: DARK,
          borderWidth: 1.5,
        },
        symbolSize: ([, , mean]: number[]) =>
          Math.max(3, LARGEST_MARK * Math.sqrt(Math.abs(mean!) / largest)),
        data: means.map(({ x, y, mean }) => [x, y, mean]),
      },
      ring(read),
    ],
  };
}

/** Round numbers beyond the outermost positions. */
function ends(values: number[]): [number, number] {
  const low = Math.min(...values);
  const high = Math.max(...values);
  return [Math.floor(low / ROUND_MM - 0.2) * ROUND_MM, Math.ceil(high / ROUND_MM + 0.2) * ROUND_MM];
}
