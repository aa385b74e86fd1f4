import { describe, expect, it } from "vitest";
import {
  isOver,
  meansOfPositions,
  medianLimit,
  ORDERINGS,
  orderingsOf,
} from "../../../src/views/diagnosis/orderings";
import { row } from "../../samples";

const ids = (...rows: Parameters<typeof orderingsOf>[0]) => orderingsOf(rows).map(({ id }) => id);
const along = (id: string, ...given: Parameters<(typeof ORDERINGS)[number]["along"]>) =>
  ORDERINGS.find((one) => one.id === id)?.along(...given);

describe("orderings", () => {
  it("by temperature are offered only where some reading has one", () => {
    expect(ids(row(), row())).not.toContain("temperature");
    expect(ids(row(), row({ temperature_rise_k: 0 }))).toContain("temperature");
    expect(ids(row())).toHaveLength(ORDERINGS.length - 1);
  });

  it.each([
    ["time", 1],
    ["order", 5],
    ["position", 10],
    ["joint1", 91],
    ["joint2", 89],
    ["travel", 5],
    ["temperature", null],
  ])("by %s take it from the reading", (id, value) => expect(along(id, row(), 4)).toBe(value));

  it("by approach keep the sides apart, and readings of one side beside each other", () => {
    const above = Array.from({ length: 50 }, (_, k) => along("approach1", row({ approach1: -1 }), k)!);
    const below = Array.from({ length: 50 }, (_, k) => along("approach1", row({ approach1: 1 }), k)!);
    expect(Math.max(...above)).toBeLessThan(-0.5);
    expect(Math.min(...below)).toBeGreaterThan(0.5);
    expect(new Set(above).size).toBe(50);
    expect(along("approach2", row({ approach2: -1 }), 0)).toBeLessThan(-0.5);
  });
});

it("a residual is over its limit only beyond it, on either side", () => {
  expect(isOver(row({ after_mm: 0.005, limit_mm: 0.005 }))).toBe(false);
  expect(isOver(row({ after_mm: 0.0051, limit_mm: 0.005 }))).toBe(true);
  expect(isOver(row({ after_mm: -0.0051, limit_mm: 0.005 }))).toBe(true);
});

it("the mean of a position is over all of its readings", () => {
  const rows = [
    row({ before_mm: 1 }),
    row({ before_mm: 3 }),
    row({ position: "B", x_mm: 20, y_mm: 410, before_mm: -4 }),
  ];
  expect(meansOfPositions(rows, (one) => one.before_mm)).toEqual([
    { x: 10, y: 400, mean: 2 },
    { x: 20, y: 410, mean: -4 },
  ]);
});

it("the limit that is drawn is the middle one, in order of size", () => {
  const limits = [0.01, 0.009, 0.2].map((limit_mm) => row({ limit_mm }));
  expect(medianLimit(limits)).toBe(0.01);
  expect(limits.map(({ limit_mm }) => limit_mm)).toEqual([0.01, 0.009, 0.2]);
});
