import { describe, expect, it } from "vitest";
import { RED } from "../../../src/parts/drawing";
import {
  draw,
  nextTo,
  orderingOption,
  positionsOption,
  type Shown,
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
const shown = (given: Partial<Shown> = {}): Shown => ({
  rows,
  ordering: by("time"),
  series: [after],
  limit_mm: null,
  span: null,
  cursor: null,
  ...given,
});

// biome-ignore lint/suspicious/noExplicitAny: the options of a chart are this loose
type Loose = Record<string, any>;

describe("residuals along an ordering", () => {
  it("are drawn in µm at the value of the ordering", () => {
    const { series, xAxis } = orderingOption(shown()) as Loose;
    // beside the dots only the ring about what is read, which is nothing yet
    expect(series).toHaveLength(2);
    expect(series[1].data).toEqual([]);
    expect(series[0].data).toEqual([
      [1, 2],
      [2, -6],
      [3, 1],
    ]);
    expect(xAxis.name).toBe("time, s");
  });

  it("have their limits dashed on both sides, from the first to the last", () => {
    const { series } = orderingOption(shown({ limit_mm: 0.005 })) as Loose;
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
    const dots = (orderingOption(shown({ limit_mm: 0.005 })) as Loose).series.at(-2);
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
    const dots = (orderingOption(shown()) as Loose).series.at(-2);
    expect(dots.symbol(null, { dataIndex: 1 })).toBe("circle");
  });

  it("have a ring about the reading that is read, and show the part that is zoomed to", () => {
    const { series, xAxis } = orderingOption(shown({ cursor: 1, span: [1.5, 3] })) as Loose;
    expect(series.at(-1).data).toEqual([[2, -6]]);
    expect([xAxis.min, xAxis.max]).toEqual([1.5, 3]);
  });

  it("have what an effect contributes as a line, where it is a function of the ordering", () => {
    const { series } = orderingOption(shown({ series: [after, contribution] })) as Loose;
    expect(series[1].type).toBe("line");
    expect(series[1].data[0]).toEqual([1, 8]);
    expect(series[1].data.at(-1)).toEqual([3, 8]);
  });

  it("have it as hollow marks where it depends on more", () => {
    const turning: Series = { name: "turning", of: (one) => (one.approach1 > 0 ? 0.008 : -0.008) };
    const mixed = Array.from({ length: 12 }, (_, k) => row({ t_s: k >> 1, approach1: k % 2 ? 1 : -1 }));
    const series = (id: string) =>
      (orderingOption(shown({ rows: mixed, ordering: by(id), series: [after, turning] })) as Loose).series[1];
    expect(series("time").itemStyle.color).toBe("transparent");
    // by the side that it depends on it is a level for each
    expect(series("approach1").data.map(([, um]: number[]) => um)).toEqual([-8, -8, null, 8, 8, null]);
  });

  it("name the unknown side only where it occurs", () => {
    const ticks = (side: number) =>
      (orderingOption(shown({ rows: [row(), row({ approach1: side })], ordering: by("approach1") })) as Loose)
        .xAxis.axisLabel;
    expect(ticks(-1).customValues).toEqual([-1, 1]);
    expect(ticks(0).customValues).toEqual([-1, 0, 1]);
    expect(ticks(0).formatter(-1)).toBe("from above");
  });
});

describe("means over the workspace", () => {
  const marks = [row({ after_mm: 0.004 }), row({ position: "B", x_mm: 130, y_mm: 440, after_mm: -0.001 })];

  it("show size by area and sign by filling", () => {
    const { series, xAxis, yAxis } = positionsOption(shown({ rows: marks })) as Loose;
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
    const { series } = positionsOption(shown({ rows: [row({ after_mm: 0 })] })) as Loose;
    expect(series[0].symbolSize([10, 400, 0])).toBe(3);
  });
});

describe("drawn into the page", () => {
  const place = () => {
    const box = document.body.appendChild(document.createElement("div"));
    Object.defineProperties(box, { clientWidth: { value: 600 }, clientHeight: { value: 300 } });
    return box;
  };

  it.each(["time", "position"])(
    "by %s it is an SVG that changes in its place, until it is taken away",
    (id) => {
      const box = place();
      const chart = draw(box, shown({ ordering: by(id), series: [after, contribution] }), () => {});
      const before = box.querySelectorAll("svg path").length;
      expect(before).toBeGreaterThan(3);
      chart.show(shown({ ordering: by(id), series: [after, contribution], cursor: 0 }));
      expect(box.querySelectorAll("svg path").length).toBeGreaterThan(before);
      expect(chart.picture()).toMatch(/^<svg .*viewBox/);
      chart.remove();
      expect(box.querySelector("svg")).toBeNull();
    },
  );
});

it("a tap reads the nearest reading within reach of a finger, and nothing beyond", () => {
  const spots: [number, number][] = [
    [0, 0],
    [100, 0],
    [Number.NaN, 5],
  ];
  expect(nextTo([70, 5], spots)).toBe(1);
  expect(nextTo([50, 50], spots)).toBeNull();
});
