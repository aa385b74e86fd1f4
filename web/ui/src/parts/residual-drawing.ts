import { LineChart, ScatterChart } from "echarts/charts";
import { GridComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import type { Calibration } from "../api";

use([LineChart, ScatterChart, GridComponent, SVGRenderer]);

const DARK = "#1b1f24";
const GREY = "#5d656e";
const RED = "#b00020";

/** Draws into `place` and follows its size; returns how to take it away. */
export function draw(place: HTMLElement, residuals: NonNullable<Calibration["residuals"]>): () => void {
  const chart = init(place, null, { renderer: "svg" });
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
  const axis = { nameTextStyle: { color: DARK, fontSize: 14 }, axisLabel: { color: DARK, fontSize: 13 } };
  chart.setOption({
    animation: false,
    grid: { left: 76, right: 24, top: 34, bottom: 48 },
    xAxis: { ...axis, type: "value", name: "reading", nameLocation: "middle", nameGap: 30, minInterval: 1, min: ({ min }: { min: number }) => min - 1, max: ({ max }: { max: number }) => max + 1 },
    yAxis: { ...axis, type: "value", name: "residual, mm (dashed: limits)", nameTextStyle: { ...axis.nameTextStyle, align: "left" } },
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
  const sized = new ResizeObserver(() => chart.resize());
  sized.observe(place);
  return () => {
    sized.disconnect();
    chart.dispose();
  };
}
