import { expect, it } from "vitest";
import type { Trend } from "../../../src/types";
import { type Charted, changes, markOf, trendOption } from "../../../src/views/history/trend-drawing";

const NO_LINES = {
  centre: null,
  sd: null,
  low: null,
  high: null,
  range_centre: null,
  range_high: null,
  at: [],
  ewma: [],
  ewma_low: [],
  ewma_high: [],
  rules: [],
};
const item = (id: number, value: number | null, kind = "calibrate") =>
  ({ id, kind, state: "succeeded", dtheta1_deg: value }) as Trend["items"][number];
const moved: Trend = {
  robot_serial: null,
  items: [item(1, 0.5), item(2, 0.7), item(3, null, "apply"), item(4, 0.4)],
  dtheta1: {
    ...NO_LINES,
    centre: 0.53,
    low: 0.1,
    high: 0.9,
    range_centre: 0.25,
    range_high: 0.8,
    at: [1, 2, 4],
    rules: [{ name: "nelson_1", at: 2 }],
  },
  dtheta2: NO_LINES,
  position_error: NO_LINES,
  effects: [],
};
const charted: Charted = {
  points: [
    [1, 0.5],
    [2, 0.7],
    [4, 0.4],
  ],
  lines: moved.dtheta1,
  unit: "°",
};

it("draws values above their moving range, marks broken rules by shape, and what was applied", () => {
  const [values, ranges] = trendOption(moved, charted).series;
  expect(values?.data).toEqual([
    [1, 0.5],
    [2, 0.7],
    [4, 0.4],
  ]);
  expect((ranges!.data as number[][]).map(([run, size]) => [run, Number(size!.toFixed(3))])).toEqual([
    [2, 0.2],
    [4, 0.3],
  ]);
  const symbol = values!.symbol as (value: number[]) => string;
  expect([symbol([1, 0.5]), symbol([2, 0.7])]).toEqual(["circle", "diamond"]);
  expect(values?.markLine.data).toContainEqual(expect.objectContaining({ xAxis: 3 }));
  expect(values?.markLine.data).toHaveLength(4);
});

it("marks the first run of another version, of those that say which", () => {
  const versions = ["0.1.0", null, "0.1.0", "0.2.0", "0.2.0"];
  const items = versions.map((software, n) => ({ ...item(n + 1, 0.5), software }) as Trend["items"][number]);
  expect(changes({ items })).toEqual([{ id: 4, software: "0.2.0" }]);
});

it("marks the runs after which the mechanism is mounted anew, and what was written", () => {
  expect(markOf({ kind: "calibrate", plan: "two_mounts" })).toBe("mount");
  expect(markOf({ kind: "gauge_study", plan: "gauge_study" })).toBe("mount");
  expect(markOf({ kind: "rollback", plan: "full" })).toBe("rollback");
  expect(markOf({ kind: "calibrate", plan: "full" })).toBeUndefined();
});
