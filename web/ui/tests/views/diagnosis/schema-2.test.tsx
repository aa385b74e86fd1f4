import { render, type VNode } from "preact";
import { describe, expect, it } from "vitest";
import { loadPhrases } from "../../../src/messages/phrases";
import { BeforeAfter } from "../../../src/parts/before-after";
import type { Diagnosis, Held, PositionError } from "../../../src/types";
import { Causes } from "../../../src/views/diagnosis/causes";
import { DiagnosisSummary } from "../../../src/views/diagnosis/diagnosis";
import { Experiments } from "../../../src/views/diagnosis/experiments";
import { Explanations } from "../../../src/views/diagnosis/explanations";
import { MistakeInData, stretches } from "../../../src/views/diagnosis/mistake";
import { calibration, diagnosed, finding } from "../../samples";

const held = (given: Partial<Held> & Pick<Held, "effect" | "joint">): Held => ({
  part: null,
  label: given.effect,
  parameters: [],
  depends_on: null,
  ...given,
});

/** A document of schema 2 whose readings leave two explanations open. */
const open: Partial<Diagnosis> = {
  schema: "station.diagnosis/2",
  verdict: "ambiguous",
  confirmed: false,
  findings: [
    finding({
      effect: "link_length",
      joint: 1,
      part: "L1",
      label: "link_length L1",
      parameters: [{ name: "L1", value: 0.31, sd: 0.02, unit: "mm" }],
      probability: 0.62,
      alias_set: [
        { effect: "link_length", joint: 1, part: "L1" },
        { effect: "scale_gain", joint: null, part: null },
      ],
    }),
  ],
  explanations: [
    { effects: [], probability: 0.004, named: true },
    {
      effects: [held({ effect: "unnamed", joint: null, depends_on: "place" })],
      probability: 0.05,
      named: false,
    },
    {
      effects: [
        held({
          effect: "link_length",
          joint: 1,
          part: "L1",
          parameters: [{ name: "L1", value: 0.31, sd: 0.02, unit: "mm" }],
        }),
        held({ effect: "backlash", joint: 2, label: "backlash of joint 2" }),
      ],
      probability: 0.62,
      named: true,
    },
    { effects: [held({ effect: "scale_gain", joint: null, part: "scale" })], probability: 0.33, named: true },
  ],
  experiments: [
    { kind: "motion", text: "Run the further diagnosis.", said: null, decides: 0.41 },
    { kind: "gauge", text: "Measure proximal link 1.", said: null, decides: 0.97 },
  ],
  mistake: {
    kind: "position_labels",
    text: "The labels of two positions are exchanged.",
    said: null,
    rows: [9, 3, 4, 5],
  },
};

const drawn = (part: VNode) => {
  const place = document.createElement("div");
  render(part, place);
  return place;
};
const rows = (part: VNode) =>
  [...drawn(part).querySelectorAll("tbody tr")].map((row) =>
    [...row.children].map((cell) => cell.textContent),
  );
const found = diagnosed(open);

it("a verdict that is not certain says so in words", () => {
  const run = calibration({ kind: "diagnose", verdict: "fail", outcome: "ambiguous" });
  const text = drawn(<DiagnosisSummary run={run} found={found} readings={120} />).textContent;
  expect(text).toContain("NOT CERTAIN");
  expect(text).toContain("Several causes account for the readings");
});

describe("explanations", () => {
  it("are ranked by their probability, in words", () =>
    expect(rows(<Explanations found={found} />)).toEqual([
      [
        "Link length error of proximal link 1 and backlash of joint 2 length error of proximal link 1 0.310 ± 0.040\u00a0mm",
        "",
        "62 %",
      ],
      ["Scale gain error of the scale", "", "33 %"],
      ["Unnamed error that depends on the position (not in the catalogue)", "", "5 %"],
      ["No error: the base model alone", "", "< 1 %"],
    ]));

  it("have a bar beside the number, which alone is read aloud", () => {
    const bars = [...drawn(<Explanations found={found} />).querySelectorAll("progress")];
    expect(bars.map(({ value }) => value)).toEqual([0.62, 0.33, 0.05, 0.004]);
    expect(bars.every((bar) => bar.getAttribute("aria-hidden") === "true")).toBe(true);
  });
});

it("experiments are ranked by the probability that they decide", () =>
  expect(rows(<Experiments found={found} />)).toEqual([
    ["Measure proximal link 1.", "", "97 %"],
    ["Run the further diagnosis.", "", "41 %"],
  ]));

it("possible causes have their probability, and alternatives their part", () => {
  const text = drawn(<Causes found={found} />).textContent;
  expect(text).toContain("Possible causes");
  expect(text).toContain("Probability62 %");
  expect(text).toContain("Alternative explanationsScale gain error");
});

describe("a mistake in the data", () => {
  it("is a sentence with its rows", () => {
    const text = drawn(<MistakeInData found={found} />).textContent;
    expect(text).toContain("The labels of two positions are exchanged.");
    expect(text).toContain("Rows of the file: 3 to 5, 9.");
  });

  it("is said by its codes once the templates are there, until then in English", async () => {
    const said = {
      code: "position_labels",
      params: { rows: { code: "readings_from_to", params: { first: 3, last: 5 } } },
    };
    const coded = { ...found, mistake: { ...found.mistake!, said } };
    await loadPhrases();
    expect(drawn(<MistakeInData found={coded} />).textContent).toContain(
      "Column position: readings that share a label stand degrees apart (readings 3 to 5); ",
    );
    const unknown = { ...coded, mistake: { ...coded.mistake, said: { code: "of_tomorrow", params: {} } } };
    expect(drawn(<MistakeInData found={unknown} />).textContent).toContain("The labels of two positions");
  });

  it.each([
    [[], []],
    [[7], ["7"]],
    [[2, 1], ["1 to 2"]],
  ])("the rows %o read %o", (given, words) => expect(stretches(given)).toEqual(words));
});

it("the bound of the position error is shown where there is one", () => {
  const error: PositionError = { rms: 0.02, max: 0.05, bound_95: 0.09 };
  const before = {
    reading_rms_mm: null,
    fresh_reading_rms_mm: null,
    fresh_reading_max_mm: null,
    predicted_position_error_mm: error,
  };
  expect(rows(<BeforeAfter result={calibration({ before, after: before })} />).at(-1)).toEqual([
    "Position error, 95 % bound, mm",
    "0.090",
    "0.090",
  ]);
});

it("a document of schema 1 has none of it", () => {
  const old = diagnosed();
  for (const part of [
    <Explanations key="1" found={old} />,
    <Experiments key="2" found={old} />,
    <MistakeInData key="3" found={old} />,
  ]) {
    expect(drawn(part).textContent).toBe("");
  }
  expect(drawn(<Causes found={old} />).textContent).not.toContain("Probability");
});
