import { describe, expect, it } from "vitest";
import { colour, scaleOf } from "../../../src/views/result/colours";
import { cells, contour, edges, kept, nearest, stepped, worst } from "../../../src/views/result/field";

const grid = { x: [0, 10, 20], y: [-20, -10] };
const values = [
  [1, 2, 3],
  [1, 2, null],
];

describe("a field of values", () => {
  it("has cells that meet half way between its points", () => expect(edges(grid.x)).toEqual([0, 5, 15, 20]));

  it("is drawn in one path for each colour, without what is null", () => {
    const paths = cells(grid, values, scaleOf([1, 2, 3]));
    expect(paths).toHaveLength(3);
    expect(paths.map(({ d }) => d.split("Z").length - 1)).toEqual([2, 2, 1]);
    expect(paths[0]?.d).toContain("M0 15H5V20H0Z");
  });

  it("crosses a limit where its values say so", () => {
    const line = contour(
      grid,
      [
        [1, 2, 3],
        [1, 2, 3],
      ],
      1.5,
    );
    const across = [...line.matchAll(/[ML](-?[\d.]+) /g)].map(([, x]) => Number(x));
    expect(across.length).toBeGreaterThan(2);
    expect(new Set(across)).toEqual(new Set([5]));
    expect(contour(grid, values, 9)).toBe("");
    // beside what is null no line is drawn
    expect(contour(grid, values, 2.5)).not.toContain("M20");
  });

  it("keeps a limit everywhere, in a part or nowhere", () => {
    expect(kept(values, 3)).toBe("everywhere");
    expect(kept(values, 2)).toBe("partly");
    expect(kept(values, 0.5)).toBe("nowhere");
  });

  it("is read at its worst point first, then by tap or arrow key, inside its edges", () => {
    expect(worst(values)).toEqual({ i: 2, j: 0 });
    expect(nearest(grid, { x: 13, y: -12 })).toEqual({ i: 1, j: 1 });
    expect(stepped(grid, { i: 0, j: 0 }, "ArrowUp")).toEqual({ i: 0, j: 1 });
    expect(stepped(grid, { i: 0, j: 0 }, "ArrowLeft")).toEqual({ i: 0, j: 0 });
    expect(stepped(grid, { i: 0, j: 0 }, "a")).toBeNull();
    expect(stepped(grid, { i: 0, j: 0 }, "constructor")).toBeNull();
  });
});

describe("the colours", () => {
  const lightness = (rgb: string) => {
    const [r, g, b] = rgb.match(/\d+/g)!.map(Number) as [number, number, number];
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };

  it("grow lighter all the way, so that they can be ordered without hue", () => {
    const shades = Array.from({ length: 50 }, (_, k) => lightness(colour(k / 49)));
    expect(shades.every((shade, k) => k === 0 || shade > shades[k - 1]!)).toBe(true);
    expect(colour(-1)).toBe(colour(0));
    expect(colour(2)).toBe(colour(1));
  });

  it("are logarithmic, with round ticks", () => {
    const scale = scaleOf([0.1, 10]);
    expect(scale.share(1)).toBeCloseTo(0.5);
    expect(scale.share(0)).toBe(0);
    expect(scale.ticks).toEqual([0.1, 0.2, 0.5, 1, 2, 5, 10]);
    const flat = scaleOf([0.4, 0.4]);
    expect(flat.share(0.4)).toBeCloseTo(1);
    expect(Number.isFinite(scaleOf([]).share(1))).toBe(true);
  });
});
