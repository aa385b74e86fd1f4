import { describe, expect, it } from "vitest";
import {
  dateTime,
  duration,
  expanded,
  fixed,
  MISSING,
  measured,
  micrometres,
  percent,
  quantity,
  signed,
  signedMicrometres,
  significant,
  timeOfDay,
} from "../src/format";

describe("fixed", () => {
  it("keeps the number of digits, with a real minus sign", () => {
    expect(fixed(1.25, 3)).toBe("1.250");
    expect(fixed(-1.25, 1)).toBe("\u22121.3");
  });

  it("writes no sign before a zero", () => expect(fixed(-0.0001, 2)).toBe("0.00"));

  it.each([null, undefined, Number.NaN, Number.POSITIVE_INFINITY])("shows %s as missing", (value) =>
    expect(fixed(value, 2)).toBe(MISSING),
  );
});

describe("signed", () => {
  it.each([
    [0.5, "+0.50"],
    [-0.5, "\u22120.50"],
    [0, "0.00"],
    [0.001, "0.00"],
    [null, MISSING],
  ])("%s becomes %s", (value, text) => expect(signed(value, 2)).toBe(text));
});

describe("micrometres", () => {
  it("states millimetres in micrometres", () => {
    expect(micrometres(0.0123, 1)).toBe("12.3");
    expect(signedMicrometres(0.0123, 1)).toBe("+12.3");
    expect(signedMicrometres(-0.0123, 1)).toBe("\u221212.3");
  });

  it("shows a missing length as missing, not as zero", () => {
    expect(micrometres(null, 1)).toBe(MISSING);
    expect(signedMicrometres(undefined, 1)).toBe(MISSING);
  });
});

describe("measured", () => {
  it.each([
    [0.049637, 0.000213, "0.04964 ± 0.00021"],
    [20.0123, 0.31, "20.01 ± 0.31"],
    [-123.4, 25, "\u2212123 ± 25"],
    [1e-12, 1e-12, "0.000000000 ± 0.000000000"],
  ])("%s ± %s has two digits of the uncertainty", (value, u, text) => expect(measured(value, u)).toBe(text));

  it("gives a value without uncertainty alone", () => {
    expect(measured(312.5, 0)).toBe("312.5");
    expect(measured(-312.5, null)).toBe("\u2212312.5");
    expect(measured(null, 1)).toBe(MISSING);
  });
});

it("expands a standard uncertainty by k = 2", () => {
  expect(expanded(0.25)).toBe(0.5);
  expect(expanded(null)).toBeNull();
});

it("shows times of the operator's own zone", () => {
  const time = new Date(2024, 2, 5, 7, 8, 9);
  expect(timeOfDay(time)).toBe("07:08:09");
  expect(dateTime(time.toISOString())).toBe("2024-03-05 07:08:09");
  expect(dateTime(null)).toBe(MISSING);
});

it.each([
  [0.4, "0 s"],
  [59.4, "59 s"],
  [59.6, "1 min 00 s"],
  [605, "10 min 05 s"],
  [null, MISSING],
])("a duration of %s s reads %s", (seconds, text) => expect(duration(seconds)).toBe(text));

it.each([
  [0, "0 %"],
  [0.004, "< 1 %"],
  [0.625, "63 %"],
  [0.996, "> 99 %"],
  [1, "100 %"],
  [Number.NaN, MISSING],
  [null, MISSING],
])("the probability %s is %s", (part, text) => expect(percent(part)).toBe(text));

it("a quantity does not break before its unit, and has none without one", () => {
  expect(quantity(1.5, 0.05, "mm")).toBe("1.50 ± 0.10\u00a0mm");
  expect(quantity(20, 0.05, "")).toBe("20.00 ± 0.10");
});

it.each([
  [0.012345, "0.012"],
  [-1234, "\u22121200"],
  [2, "2"],
  [null, "–"],
  [Number.NaN, "–"],
])("%s to two significant digits is %s", (value, text) => expect(significant(value, 2)).toBe(text));
