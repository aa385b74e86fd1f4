import { LineChart, ScatterChart } from "echarts/charts";
import { GridComponent } from "echarts/components";
import { use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import type { Calibration } from "../../api";
import { DARK, GREY, mount, RED, xAxis, yAxis } from "../../parts/drawing";

use([LineChart, ScatterChart, GridComponent, SVGRenderer]);

/** Draws into `place`; returns how to take it away. */
export function draw(place: HTMLElement, residuals: NonNullable<Calibration["residuals"]>): () => void {
  const over = (i: number) => {
    const { residual_mm: residual, limit_mm: limit } = residuals[i]!;
    return residual !== null && limit !== null && Math.abs(residual) > limit;
  };
  const limits = (sign: 1 | -1) => ({
    type: "line" as const,
    data: residuals.map((r) => [r.reading, r.limit_mm === null ? null : sign * r.limit_mm]),
    symbol: "none",
    step: "middle" as const,
    silent: true,
    lineStyle: { color: GREY, type: "dashed" as const, width: 1.5 },
  });
  return mount(place, {
    xAxis: {
      ...xAxis,
      name: "reading",
      minInterval: 1,
      min: ({ min }: { min: number }) => min - 1,
      max: ({ max }: { max: number }) => max + 1,
    },
    yAxis: { ...yAxis, name: "residual, mm (dashed: limits)" },
    series: [
      limits(1),
      limits(-1),
      {
        type: "scatter",
        silent: true,
        symbolSize: (_: unknown, { dataIndex }: { dataIndex: number }) => (over(dataIndex) ? 13 : 8),
        symbol: (_: unknown, { dataIndex }: { dataIndex: number }) => (over(dataIndex) ? "diamond" : "circle"),
        itemStyle: { color: ({ dataIndex }: { dataIndex: number }) => (over(dataIndex) ? RED : DARK) },
        data: residuals.map((r) => [r.reading, r.residual_mm]),
      },
    ],
  });
}
