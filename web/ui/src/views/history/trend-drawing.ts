import { LineChart, ScatterChart } from "echarts/charts";
import { GridComponent, MarkLineComponent } from "echarts/components";
import { use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import { fixed } from "../../format";
import { t } from "../../messages";
import { DARK, GREY, mount, RED, xAxis, yAxis } from "../../parts/drawing";
import type { ChartLines, Trend } from "../../types";

use([LineChart, ScatterChart, GridComponent, MarkLineComponent, SVGRenderer]);

/** Run and value of each point, with the lines of their chart. */
export interface Charted {
  points: [number, number][];
  lines: ChartLines;
  unit: string;
}

const short = (value: number) => fixed(value, 3);

/** Draws into `place`; returns a function to remove the chart. */
export function draw(place: HTMLElement, moved: Trend, charted: Charted): () => void {
  return mount(place, trendOption(moved, charted));
}

/**
 * Individuals above, moving ranges below; broken rules as diamonds, writing of zeros and remounting as lines.
 */
export function trendOption(moved: Trend, { points, lines, unit }: Charted) {
  const broken = new Set(lines.rules.map(({ at }) => at));
  const ranges = points
    .slice(1)
    .map(([run, value], n) => [run, Math.abs(value - points[n]![1])] as [number, number]);
  const shown = [...moved.items.map(({ id }) => id), ...lines.at];
  const runs = { ...xAxis, minInterval: 1, min: Math.min(...shown) - 1, max: Math.max(...shown) + 1 };
  // the limits must be visible even if every value is well within them
  const reach = (values: number[], limits: (number | null)[]) => {
    const all = [...values, ...limits.filter((limit) => limit !== null)];
    const margin = 0.05 * (Math.max(...all) - Math.min(...all));
    return { min: Math.min(...all) - margin, max: Math.max(...all) + margin };
  };
  const rounded = {
    axisLabel: { ...yAxis.axisLabel, showMinLabel: false, showMaxLabel: false, formatter: short },
  };
  const level = (y: number | null, dashed: boolean) =>
    y === null ? [] : [{ yAxis: y, lineStyle: { type: dashed ? ("dashed" as const) : ("solid" as const) } }];
  const done = moved.items.flatMap((item) => {
    const mark = item.state === "succeeded" ? markOf(item) : undefined;
    return mark ? [{ xAxis: item.id, label: { formatter: t.history.marks[mark], rotate: 0 } }] : [];
  });
  const versions = changes(moved).map(({ id, software }) => ({
    xAxis: id,
    label: { formatter: t.history.version(software), rotate: 0 },
  }));
  const marks = (data: object[]) => ({
    silent: true,
    symbol: "none",
    label: { show: true, formatter: "", color: DARK },
    lineStyle: { color: GREY },
    data,
  });
  return {
    grid: [
      { left: 76, right: 24, top: 34, height: 120 },
      { left: 76, right: 24, top: 190, bottom: 44 },
    ],
    xAxis: [
      { ...runs, gridIndex: 0, axisLabel: { show: false } },
      { ...runs, gridIndex: 1, name: t.history.runAxis },
    ],
    yAxis: [
      {
        ...yAxis,
        ...rounded,
        gridIndex: 0,
        name: unit,
        ...reach(
          points.map(([, value]) => value),
          [lines.low, lines.high],
        ),
      },
      {
        ...yAxis,
        ...rounded,
        gridIndex: 1,
        name: t.history.rangeAxis(unit),
        splitNumber: 2,
        ...reach(
          ranges.map(([, size]) => size),
          [0, lines.range_high],
        ),
      },
    ],
    series: [
      {
        type: "line" as const,
        data: points,
        lineStyle: { color: GREY, width: 1 },
        itemStyle: {
          color: ({ dataIndex }: { dataIndex: number }) => (broken.has(points[dataIndex]![0]) ? RED : DARK),
        },
        symbol: (value: number[]) => (broken.has(value[0]!) ? "diamond" : "circle"),
        symbolSize: (value: number[]) => (broken.has(value[0]!) ? 14 : 6),
        markLine: marks([
          ...level(lines.centre, false),
          ...level(lines.low, true),
          ...level(lines.high, true),
          ...done,
          ...versions,
        ]),
      },
      {
        type: "line" as const,
        xAxisIndex: 1,
        yAxisIndex: 1,
        data: ranges,
        lineStyle: { color: GREY, width: 1 },
        itemStyle: { color: DARK },
        symbolSize: 5,
        markLine: marks([...level(lines.range_centre, false), ...level(lines.range_high, true)]),
      },
    ],
  };
}

/** Changes that a run made to the drives or the mechanism, beside measuring. */
export function markOf({ kind, plan }: Pick<Trend["items"][number], "kind" | "plan">) {
  if (kind === "apply" || kind === "rollback") return kind;
  return kind === "gauge_study" || plan === "two_mounts" ? "mount" : undefined;
}

/** The first run of each further version of the program, among those with a known version. */
export function changes({ items }: Pick<Trend, "items">): { id: number; software: string }[] {
  const known = items.flatMap(({ id, software }) => (software ? [{ id, software }] : []));
  return known.filter(({ software }, n) => n > 0 && software !== known[n - 1]!.software);
}
