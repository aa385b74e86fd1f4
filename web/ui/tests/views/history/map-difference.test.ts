import { describe, expect, it } from "vitest";
import type { ErrorMap } from "../../../src/types";
import { difference } from "../../../src/views/history/map-difference";
import { evenScale } from "../../../src/views/result/colours";

const map = (after_95_mm: (number | null)[][], x_mm = [0, 1]): ErrorMap => ({
  x_mm,
  y_mm: [0],
  before_mm: after_95_mm,
  after_mm: after_95_mm,
  after_95_mm,
  bound_95_mm: 1,
  limit_mm: null,
  fresh: [],
});

describe("the difference of two error maps", () => {
  it("is the second less the first, nothing where one has no value", () => {
    expect(difference(map([[1, null]]), map([[0.25, 2]]))).toEqual([[-0.75, null]]);
  });

  it("is none of two workspaces", () => {
    expect(difference(map([[1, 2]]), map([[1, 2]], [0, 2]))).toBeNull();
  });

  it("is shown on a scale whose middle is no difference", () => {
    const scale = evenScale(0.5);
    expect([-0.5, 0, 0.5].map(scale.share)).toEqual([0, 0.5, 1]);
    expect(evenScale(0).share(0)).toBe(0.5);
  });
});
