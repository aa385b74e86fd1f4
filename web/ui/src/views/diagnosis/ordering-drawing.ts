import { LineChart, ScatterChart } from "echarts/charts";
import { GridComponent } from "echarts/components";
import { use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import { micrometres } from "../../format";
import { t } from "../../messages";
import { DARK, GREY, mount, RED, xAxis, yAxis } from "../../parts/drawing";
import type { ResidualRow } from "../../types";
import { isOver, MARKS, meansOfPositions, type Ordering, type Series } from "./orderings";

use([LineChart, ScatterChart, GridComponent, SVGRenderer]);

const UM = 1000;
const LARGEST_MARK = 34;
const ROUND_MM = 50;

/** The first series as dots, others over it as hollow marks; `limit_mm` is drawn dashed where given. */
export function drawOrdering(
  place: HTMLElement,
  rows: ResidualRow[],
  ordering: Ordering,
  series: [Series, ...Series[]],
  limit_mm: number | null,
): () => void {
  return mount(place, orderingOption(rows, ordering, series, limit_mm));
}

export function orderingOption(
  rows: ResidualRow[],
  ordering: Ordering,
  [dots, ...marks]: [Series, ...Series[]],
  limit_mm: number | null,
) {
  const along = rows.map((row, index) => ordering.along(row, index));
  const points = ({ of }: Series) => rows.map((row, index) => [along[index], UM * of(row)]);
  const known = along.filter((value) => value !== null);
  const [left, right] = ordering.words ? [-1.5, 1.5] : [Math.min(...known), Math.max(...known)];
  const over = ({ dataIndex }: { dataIndex: number }) => limit_mm !== null && isOver(rows[dataIndex]!);
  const limits = limit_mm === null ? [] : [UM * limit_mm, -UM * limit_mm];
  return {
    xAxis: { ...xAxis, name: ordering.axis, ...(ordering.words && sidesAxis(ordering.words, known)) },
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
      ...marks.map((series, k) => ({
        type: "scatter",
        silent: true,
        symbol: MARKS[k % MARKS.length]!.symbol,
        symbolSize: 11,
        itemStyle: { color: "transparent", borderColor: GREY, borderWidth: 1.5 },
        data: points(series),
      })),
    ],
  };
}

/** An axis of few values in words; the one for "unknown" only where it occurs. */
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
export function drawPositions(place: HTMLElement, rows: ResidualRow[], series: Series): () => void {
  return mount(place, positionsOption(rows, series));
}

export function positionsOption(rows: ResidualRow[], { of }: Series) {
  const means = meansOfPositions(rows, of);
  const largest = Math.max(...means.map(({ mean }) => Math.abs(mean))) || 1;
  const [left, right] = ends(means.map(({ x }) => x));
  const [bottom, top] = ends(means.map(({ y }) => y));
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
    ],
  };
}

/** Round numbers beyond the outermost positions. */
function ends(values: number[]): [number, number] {
  const low = Math.min(...values);
  const high = Math.max(...values);
  return [Math.floor(low / ROUND_MM - 0.2) * ROUND_MM, Math.ceil(high / ROUND_MM + 0.2) * ROUND_MM];
}
