import { describe, expect, it } from "vitest";
import { RED } from "../../../src/parts/drawing";
import {
  drawOrdering,
  drawPositions,
  orderingOption,
  positionsOption,
} from "../../../src/views/diagnosis/ordering-drawing";
import { ORDERINGS, type Series } from "../../../src/views/diagnosis/orderings";
import { row } from "../../samples";

const by = (id: string) => ORDERINGS.find((one) => one.id === id)!;
const after: Series = { name: "after", of: (one) => one.after_mm };
const contribution: Series = { name: "backlash", of: (one) => one.by_effect_mm[0]! };
const rows = [
  row({ t_s: 1, after_mm: 0.002 }),
  row({ t_s: 2, after_mm: -0.006 }),
  row({ t_s: 3, after_mm: 0.001 }),
];
// biome-ignore lint/suspicious/noExplicitAny: the options of a chart are this loose
type Loose = Record<string, any>;

describe("residuals along an ordering", () => {
  it("are drawn in µm at the value of the ordering", () => {
    const { series, xAxis } = orderingOption(rows, by("time"), [after], null) as Loose;
    expect(series).toHaveLength(1);
    expect(series[0].data).toEqual([
      [1, 2],
      [2, -6],
      [3, 1],
    ]);
    expect(xAxis.name).toBe("time, s");
  });

  it("have their limits dashed on both sides, from the first to the last", () => {
    const { series } = orderingOption(rows, by("time"), [after], 0.005) as Loose;
    expect(series.slice(0, 2).map((one: Loose) => one.data)).toEqual([
      [
        [1, 5],
        [3, 5],
      ],
      [
        [1, -5],
        [3, -5],
      ],
    ]);
  });

  it("over the limit are red diamonds, the others are not", () => {
    const dots = (orderingOption(rows, by("time"), [after], 0.005) as Loose).series.at(-1);
    const looks = rows.map((_, dataIndex) => [
      dots.symbol(null, { dataIndex }),
      dots.itemStyle.color({ dataIndex }) === RED,
    ]);
    expect(looks).toEqual([
      ["circle", false],
      ["diamond", true],
      ["circle", false],
    ]);
  });

  it("without a limit are over none", () => {
    const dots = (orderingOption(rows, by("time"), [after], null) as Loose).series.at(-1);
    expect(dots.symbol(null, { dataIndex: 1 })).toBe("circle");
  });

  it("have the contribution of each effect over them as hollow marks", () => {
    const { series } = orderingOption(rows, by("time"), [after, contribution], null) as Loose;
    expect(series[1].data).toEqual([
      [1, 8],
      [2, 8],
      [3, 8],
    ]);
    expect(series[1].itemStyle.color).toBe("transparent");
  });

  it("name the unknown side only where it occurs", () => {
    const ticks = (side: number) =>
      (orderingOption([row(), row({ approach1: side })], by("approach1"), [after], null) as Loose).xAxis
        .axisLabel;
    expect(ticks(-1).customValues).toEqual([-1, 1]);
    expect(ticks(0).customValues).toEqual([-1, 0, 1]);
    expect(ticks(0).formatter(-1)).toBe("from above");
  });
});

describe("means over the workspace", () => {
  const marks = [row({ after_mm: 0.004 }), row({ position: "B", x_mm: 130, y_mm: 440, after_mm: -0.001 })];

  it("show size by area and sign by filling", () => {
    const { series, xAxis, yAxis } = positionsOption(marks, after) as Loose;
    const [{ symbolSize, itemStyle, data }] = series;
    expect(data).toEqual([
      [10, 400, 0.004],
      [130, 440, -0.001],
    ]);
    expect(symbolSize(data[0]) / symbolSize(data[1])).toBeCloseTo(2);
    expect(itemStyle.color({ value: data[0] })).not.toBe("transparent");
    expect(itemStyle.color({ value: data[1] })).toBe("transparent");
    expect(xAxis.name).toContain("4.0 µm");
    expect([xAxis.min, xAxis.max, yAxis.min, yAxis.max]).toEqual([0, 150, 350, 450]);
  });

  it("that are all zero are drawn small, not infinitely large", () => {
    const { series } = positionsOption([row({ after_mm: 0 })], after) as Loose;
    expect(series[0].symbolSize([10, 400, 0])).toBe(3);
  });
});

describe("drawn into the page", () => {
  const place = () => {
    const box = document.body.appendChild(document.createElement("div"));
    Object.defineProperties(box, { clientWidth: { value: 600 }, clientHeight: { value: 300 } });
    return box;
  };

  it.each([
    ["an ordering", (box: HTMLElement) => drawOrdering(box, rows, by("time"), [after, contribution], 0.005)],
    ["the positions", (box: HTMLElement) => drawPositions(box, rows, after)],
  ])("%s is an SVG, until it is taken away", (_, draw) => {
    const box = place();
    const remove = draw(box);
    expect(box.querySelectorAll("svg path").length).toBeGreaterThan(3);
    remove();
    expect(box.querySelector("svg")).toBeNull();
  });
});
