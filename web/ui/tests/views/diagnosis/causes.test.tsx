import { render } from "preact";
import { describe, expect, it } from "vitest";
import type { Diagnosis } from "../../../src/types";
import { Causes } from "../../../src/views/diagnosis/causes";
import { Invisible } from "../../../src/views/diagnosis/invisible";
import { Stages } from "../../../src/views/diagnosis/stages";
import { diagnosed, finding } from "../../samples";

const drawn = (
  Part: (props: { found: Diagnosis }) => preact.JSX.Element | null,
  given: Partial<Diagnosis> = {},
) => {
  const place = document.createElement("div");
  render(<Part found={diagnosed(given)} />, place);
  return place;
};
const causes = (given?: Partial<Diagnosis>) => drawn(Causes, given).textContent;

describe("causes", () => {
  it("have a display name, a size with expanded uncertainty and a share", () => {
    const text = causes();
    expect(text).toContain("Backlash of joint 2");
    expect(text).toContain("Width 0.04960 ± 0.00020\u00a0°");
    expect(text).toContain("97.0 %");
  });

  it("name the alternatives, not the effect itself, and how to distinguish them", () => {
    const alias_set = [
      { effect: "thermal_growth", joint: null, part: null },
      { effect: "drift", joint: null, part: null },
    ];
    const one = finding({
      effect: "thermal_growth",
      joint: null,
      label: "thermal_growth",
      alias_set,
      separating_experiment: "Stand still.",
    });
    const place = drawn(Causes, { findings: [one] });
    const values = [...place.querySelectorAll("dl > div")].map((part) => part.textContent);
    expect(values).toContain("Alternative explanationsDrift");
    expect(place.textContent).toContain("To distinguish the alternatives: Stand still.");
  });

  it("without alternatives say so", () => expect(causes()).toContain("no other effect of the catalogue"));

  it.each([
    ["unexplained", null, false],
    ["partly_explained", false, false],
    ["partly_explained", true, true],
    ["explained", true, true],
  ] as const)(
    "that leave the readings %s (confirmed: %s) have a remedy: %s",
    (verdict, confirmed, remedy) => {
      const text = causes({ verdict, confirmed });
      expect(text?.includes("Adjust the reducer.")).toBe(remedy);
      expect(text?.includes("none of them is the cause")).toBe(!remedy);
    },
  );
});

it("detection limits have two digits and the page's unit", () => {
  const invisible = [
    {
      effect: "scale_cyclic",
      joint: null,
      part: null,
      label: "scale_cyclic",
      parameter: "amplitude_mm",
      minimum_detectable: 0.0012345,
      unit: "mm",
      text: "",
      said: null,
    },
    {
      effect: "count_slip",
      joint: 1,
      part: null,
      label: "count_slip of joint 1",
      parameter: null,
      minimum_detectable: null,
      unit: null,
      text: "not shown",
      said: null,
    },
  ];
  const cells = [...drawn(Invisible, { invisible }).querySelectorAll("tbody tr")].map((one) =>
    [...one.children].map((cell) => cell.textContent),
  );
  expect(cells).toEqual([
    ["Scale ripple", "1.2 µm", "Amplitude", ""],
    ["Slip of joint 1", "–", "", "Not shown"],
  ]);
});

it("models are compared in µm, with a dash where nothing was measured afresh", () => {
  const errors = {
    unknowns: 12,
    fit_rms_mm: 0.00312,
    holdout_rms_mm: 0.004,
    holdout_max_mm: 0.01,
    confirm_rms_mm: null,
    confirm_max_mm: 0.01,
  };
  const cells = drawn(Stages, { stages: [{ model: "+ backlash of joint 2", ...errors }] }).querySelectorAll(
    "tbody tr > *",
  );
  expect([...cells].map((cell) => cell.textContent)).toEqual([
    "+ backlash of joint 2",
    "12",
    "3.12",
    "4.00",
    "–",
    "10.00",
  ]);
});
