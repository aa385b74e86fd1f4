/** Common parts of all charts: placement, colours and axes. */
import { type ECharts, type EChartsCoreOption, init } from "echarts/core";

export const DARK = "#1b1f24";
export const GREY = "#5d656e";
export const RED = "#b00020";

export const axis = {
  nameTextStyle: { color: DARK, fontSize: 14 },
  axisLabel: { color: DARK, fontSize: 13 },
};

/** The x axis, with its name below, and a margin beside the first and last point. */
export const xAxis = {
  ...axis,
  type: "value" as const,
  nameLocation: "middle" as const,
  nameGap: 30,
  scale: true,
};

/** The y axis, with its name above. */
export const yAxis = {
  ...axis,
  type: "value" as const,
  nameTextStyle: { ...axis.nameTextStyle, align: "left" as const },
  axisLine: { onZero: false },
};

export const grid = { left: 76, right: 24, top: 34, bottom: 48 };

/** A chart in its place. */
export interface Chart {
  /** Shows another chart in the same place. */
  set: (option: EChartsCoreOption) => void;
  /** The chart as the text of an SVG file. */
  picture: () => string;
  remove: () => void;
}

/** Position of a value pair in the chart, in pixels. */
export type ToPixel = (value: [number, number]) => [number, number];

/**
 * Draws into `place` and follows its size.
 *
 * @param tapped position of a tap, in pixels
 */
export function put(
  place: HTMLElement,
  option: EChartsCoreOption,
  tapped: (at: [number, number], toPixel: ToPixel) => void = () => {},
): Chart {
  const chart: ECharts = init(place, null, { renderer: "svg" });
  const fit = () => {
    chart.resize();
    // so that paper and narrow windows can scale a chart that was drawn for another width
    place.querySelector("svg")?.setAttribute("viewBox", `0 0 ${chart.getWidth()} ${chart.getHeight()}`);
  };
  const set = (next: EChartsCoreOption) =>
    chart.setOption({ animation: false, grid, ...next }, { notMerge: true });
  set(option);
  chart
    .getZr()
    .on("click", ({ offsetX, offsetY }) =>
      tapped(
        [offsetX, offsetY],
        (value) => chart.convertToPixel({ gridIndex: 0 }, value) as [number, number],
      ),
    );
  const sized = new ResizeObserver(fit);
  sized.observe(place);
  return {
    set,
    picture: () => chart.renderToSVGString({ useViewBox: true }),
    remove: () => {
      sized.disconnect();
      chart.dispose();
    },
  };
}

/** The same for a place with one chart only; returns a function to remove it. */
export function mount(place: HTMLElement, option: EChartsCoreOption): () => void {
  return put(place, option).remove;
}
