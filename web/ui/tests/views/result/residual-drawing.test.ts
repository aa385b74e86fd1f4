import { expect, it } from "vitest";
import type { Residual } from "../../../src/types";
import { isOver } from "../../../src/views/result/over-limit";
import { draw, residualOption } from "../../../src/views/result/residual-drawing";

const residual = (reading: number, residual_mm: number | null, limit_mm: number | null): Residual => ({
  reading,
  position: null,
  residual_mm,
  limit_mm,
});
const residuals = [
  residual(1, 0.003, 0.005),
  residual(2, -0.008, 0.005),
  residual(4, null, 0.006),
  residual(5, 0.9, null),
];

it("a residual is over its limit on either side, and never without a limit", () => {
  expect(residuals.map(isOver)).toEqual([false, true, false, false]);
  expect(isOver(residual(1, 0.005, 0.005))).toBe(false);
});

it("draws residuals and their limits in µm by number of the reading", () => {
  const [upper, lower, dots] = residualOption(residuals).series;
  expect(dots?.data).toEqual([
    [1, 3],
    [2, -8],
    [4, null],
    [5, 900],
  ]);
  expect(upper?.data).toEqual([
    [1, 5],
    [2, 5],
    [4, 6],
    [5, null],
  ]);
  expect(lower?.data.map(([, limit]) => limit)).toEqual([-5, -5, -6, null]);
});

it("draws a diamond where a residual is over its limit", () => {
  const { symbol, symbolSize } = residualOption(residuals).series[2] as {
    symbol: (value: unknown, point: { dataIndex: number }) => string;
    symbolSize: (value: unknown, point: { dataIndex: number }) => number;
  };
  expect(residuals.map((_, dataIndex) => symbol(null, { dataIndex }))).toEqual([
    "circle",
    "diamond",
    "circle",
    "circle",
  ]);
  expect(symbolSize(null, { dataIndex: 1 })).toBeGreaterThan(symbolSize(null, { dataIndex: 0 }));
});

it("leaves room beside the first and the last reading", () => {
  const { xAxis } = residualOption(residuals);
  expect([xAxis.min({ min: 1 }), xAxis.max({ max: 5 })]).toEqual([0, 6]);
});

it("is an SVG, until it is taken away", () => {
  const box = document.body.appendChild(document.createElement("div"));
  Object.defineProperties(box, { clientWidth: { value: 600 }, clientHeight: { value: 300 } });
  const remove = draw(box, residuals);
  expect(box.querySelectorAll("svg path").length).toBeGreaterThan(3);
  remove();
  expect(box.querySelector("svg")).toBeNull();
});
