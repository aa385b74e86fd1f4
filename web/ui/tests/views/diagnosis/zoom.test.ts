import { expect, it } from "vitest";
import { signature } from "../../../src/views/diagnosis/signature";
import {
  readSpan,
  type Span,
  showing,
  writeSpan,
  zoomedIn,
  zoomedOut,
} from "../../../src/views/diagnosis/zoom";

const whole: Span = [0, 100];

it("the address names a part of the whole, or nothing", () => {
  expect(readSpan("20,40", whole)).toEqual([20, 40]);
  expect(readSpan("-20,40", whole)).toEqual([0, 40]);
  for (const text of [null, "", "20", "40,20", "a,b", "0,100", "120,140"])
    expect(readSpan(text, whole)).toBeNull();
  expect(readSpan(writeSpan([1.25, 50.5]), whole)).toEqual([1.25, 50.5]);
  expect(writeSpan(null)).toBe("");
});

it("zooming halves and doubles what is in sight, and stays inside", () => {
  expect(zoomedIn(whole, null, 30)).toEqual([5, 55]);
  expect(zoomedIn(whole, [40, 60], 59)).toEqual([54, 64]);
  expect(zoomedIn(whole, null, 99)).toEqual([50, 100]);
  expect(zoomedOut(whole, [40, 60])).toEqual([30, 70]);
  expect(zoomedOut(whole, [10, 70])).toBeNull();
  expect(zoomedOut(whole, null)).toBeNull();
  let span: Span = whole;
  for (let k = 0; k < 50; k++) span = zoomedIn(whole, span, 50);
  expect(span[1] - span[0]).toBeGreaterThan(0.1);
});

it("what is read is moved into sight", () => {
  expect(showing(whole, [40, 60], 50)).toEqual([40, 60]);
  expect(showing(whole, [40, 60], 80)).toEqual([70, 90]);
  expect(showing(whole, null, 80)).toBeNull();
});

it("a signature follows a wave, and is broken where nothing was measured", () => {
  const along = Array.from({ length: 200 }, (_, k) => k / 2).filter((x) => x < 40 || x > 60);
  const wave = (x: number) => Math.sin(x / 4);
  const line = signature(along, along.map(wave))!;
  const known = line.filter((point): point is [number, number] => point[1] !== null);
  const inside = known.filter(([x]) => [0, 40, 60, 100].every((edge) => Math.abs(x - edge) > 4));
  expect(inside.length).toBeGreaterThan(80);
  expect(Math.max(...inside.map(([x, y]) => Math.abs(y - wave(x))))).toBeLessThan(0.2);
  expect(line.some(([x, y]) => y === null && Math.abs(x - 50) < 2)).toBe(true);
  expect(signature([1, null], [1, 1])).toBeNull();
  expect(signature([1, 1], [1, 1])).toBeNull();
});
