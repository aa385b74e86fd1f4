/** What all charts share: how they are put in place, their colours and axes. */
import { type ECharts, type EChartsCoreOption, init } from "echarts/core";

export const DARK = "#1b1f24";
export const GREY = "#5d656e";
export const RED = "#b00020";

export const axis = {
  nameTextStyle: { color: DARK, fontSize: 14 },
  axisLabel: { color: DARK, fontSize: 13 },
};

/** The x axis, named below, with a little room beside the first and last point. */
export const xAxis = {
  ...axis,
  type: "value" as const,
  nameLocation: "middle" as const,
  nameGap: 30,
  scale: true,
};

/** The y axis, named above. */
export const yAxis = {
  ...axis,
  type: "value" as const,
  nameTextStyle: { ...axis.nameTextStyle, align: "left" as const },
  axisLine: { onZero: false },
};

export const grid = { left: 76, right: 24, top: 34, bottom: 48 };

/** Draws into `place` and follows its size; returns how to take it away. */
export function mount(place: HTMLElement, option: EChartsCoreOption): () => void {
  const chart: ECharts = init(place, null, { renderer: "svg" });
  chart.setOption({ animation: false, grid, ...option });
  const sized = new ResizeObserver(() => chart.resize());
  sized.observe(place);
  return () => {
    sized.disconnect();
    chart.dispose();
  };
}
