import { LineChart, ScatterChart } from "echarts/charts";
import { GridComponent } from "echarts/components";
import { use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import { t } from "../../messages";
import { DARK, GREY, mount, RED, xAxis, yAxis } from "../../parts/drawing";
import type { Residual } from "../../types";
import { isOver } from "./over-limit";

use([LineChart, ScatterChart, GridComponent, SVGRenderer]);

const UM = 1000;

/** Draws into `place`; returns a function to remove the chart. */
export function draw(place: HTMLElement, residuals: Residual[], reach?: number): () => void {
  return mount(place, residualOption(residuals, reach));
}

/** Largest residual or limit, in µm: for drawing several runs on one scale. */
export const reachOf = (residuals: Residual[]): number =>
  UM * Math.max(0, ...residuals.flatMap((r) => [Math.abs(r.residual_mm ?? 0), r.limit_mm ?? 0]));

/**
 * Residuals as dots, those over their limit as diamonds, the limits dashed; from -reach to reach if it is
 * given.
 */
export function residualOption(residuals: Residual[], reach?: number) {
  const over = ({ dataIndex }: { dataIndex: number }) => isOver(residuals[dataIndex]!);
  const limits = (sign: 1 | -1) => ({
    type: "line" as const,
    data: residuals.map((r) => [r.reading, r.limit_mm === null ? null : sign * UM * r.limit_mm]),
    symbol: "none",
    step: "middle" as const,
    silent: true,
    lineStyle: { color: GREY, type: "dashed" as const, width: 1.5 },
  });
  return {
    xAxis: {
      ...xAxis,
      name: t.result.readingAxis,
      minInterval: 1,
      min: ({ min }: { min: number }) => min - 1,
      max: ({ max }: { max: number }) => max + 1,
    },
    yAxis: {
      ...yAxis,
      name: t.result.residualAxis,
      ...(reach === undefined ? {} : { min: -Math.ceil(1.05 * reach), max: Math.ceil(1.05 * reach) }),
    },
    series: [
      limits(1),
      limits(-1),
      {
        type: "scatter" as const,
        silent: true,
        symbolSize: (_: unknown, point: { dataIndex: number }) => (over(point) ? 13 : 8),
        symbol: (_: unknown, point: { dataIndex: number }) => (over(point) ? "diamond" : "circle"),
        itemStyle: { color: (point: { dataIndex: number }) => (over(point) ? RED : DARK) },
        data: residuals.map((r) => [r.reading, r.residual_mm === null ? null : UM * r.residual_mm]),
      },
    ],
  };
}
