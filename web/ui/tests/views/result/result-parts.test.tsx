import { render, type VNode } from "preact";
import { describe, expect, it } from "vitest";
import { BeforeAfter } from "../../../src/parts/before-after";
import type { Calibration } from "../../../src/types";
import { statement } from "../../../src/views/result/drive-state";
import { FindCause } from "../../../src/views/result/find-cause";
import { ResultSummary, RunFacts, Ways } from "../../../src/views/result/result-summary";
import { ZeroOffsets } from "../../../src/views/result/zero-offsets";
import { calibration } from "../../samples";

const drawn = (part: VNode) => {
  const place = document.createElement("div");
  render(part, place);
  return place;
};
const cells = (part: VNode) =>
  [...drawn(part).querySelectorAll("tbody tr")].map((row) =>
    [...row.children].map((cell) => cell.textContent),
  );

describe("zero offsets", () => {
  const zero_offsets = [
    { joint: 1, value_deg: 0.5, sd_deg: 0.01 },
    { joint: 2, value_deg: -1.2, sd_deg: null },
  ];

  it("have the expanded and the standard uncertainty, and are compared with the tolerance", () =>
    expect(cells(<ZeroOffsets result={calibration({ zero_offsets })} />)).toEqual([
      ["1", "+0.5000 ± 0.0200", "0.0100", "1.0", "within"],
      ["2", "\u22121.2000 ± –", "–", "1.0", "◆ outside"],
    ]));

  it("are judged by nothing where there is no tolerance", () =>
    expect(
      cells(<ZeroOffsets result={calibration({ zero_offsets, zero_offset_tolerance_deg: null })} />).map(
        (row) => row.at(-1),
      ),
    ).toEqual(["–", "–"]));

  it("come with what else was identified, by display names", () => {
    const parameters = [{ name: "rMx", value: 1.5, sd: 0.25, unit: "mm" }];
    expect(cells(<ZeroOffsets result={calibration({ zero_offsets, parameters })} />).at(-1)).toEqual([
      "Mounting error of the mechanism, sideways",
      "+1.500 ± 0.500 mm",
    ]);
  });
});

describe("the misfit of the model", () => {
  const text = (given: Partial<Calibration>) =>
    drawn(<FindCause result={calibration({ verdict: "fail", ...given })} />).textContent;
  const misfit: Partial<Calibration> = {
    lack_of_fit: "As the station says it.",
    lack_of_fit_reason: { code: "verified", params: { rms_um: 3.14 } },
  };

  it("is stated by its code, and by its sentence in results of older versions", () => {
    expect(text(misfit)).toContain("Verified: fresh readings agree within 3.1 µm.");
    expect(text({ ...misfit, lack_of_fit_reason: null })).toContain("As the station says it.");
  });

  it("is not stated again where it is the reason of the run", () =>
    expect(text({ ...misfit, reason: "As the station says it." })).not.toContain("Verified"));
});

describe("the statement about the drives", () => {
  it.each([
    ["applied", true, "✓ Written. Verified."],
    ["applied", false, "○ Written. Not verified."],
    ["rolled back", true, "✓ Written."],
    ["in doubt", false, "▲ Written."],
    ["partly", true, "▲ Written."],
  ] as const)("that are %s, verified %s", (state, verified, text) =>
    expect(statement({ state, verified, text: "Written." })).toBe(text),
  );
});

it("before and after are in µm for residuals and in mm for positions, without what is unknown", () => {
  const before = {
    reading_rms_mm: 0.0123,
    fresh_reading_rms_mm: null,
    fresh_reading_max_mm: null,
    predicted_position_error_mm: { rms: 1.5, max: 3, bound_95: null },
  };
  const after = { ...before, reading_rms_mm: 0.0021, predicted_position_error_mm: null };
  expect(cells(<BeforeAfter result={calibration({ before, after })} />)).toEqual([
    ["Residual of the readings, RMS, µm", "12.30", "2.10"],
    ["Predicted position error, RMS, mm", "1.500", "–"],
    ["Predicted position error, largest, mm", "3.000", "–"],
  ]);
});

describe("the head of a result", () => {
  const heading = (given: Partial<Calibration>) =>
    drawn(<ResultSummary result={calibration(given)} />).querySelector("h1")?.textContent;
  const links = (given: Partial<Calibration>) =>
    [...drawn(<Ways result={calibration(given)} />).querySelectorAll("a")].map((link) => link.textContent);

  it("names what a run was for", () => {
    expect(heading({ id: 4 })).toBe("Result of run 4");
    expect(heading({ id: 5, kind: "separate", plan: "separating", of: 4 })).toBe(
      "Result of run 5: Further diagnosis (run 4)",
    );
  });

  it("gives the plan of what measures by one", () => {
    const facts = (given: Partial<Calibration>) =>
      drawn(<RunFacts result={calibration(given)} />).querySelector("dl")?.textContent;
    expect(facts({ plan: "full" })).toContain("Kind of runCalibrationPlanFull");
    expect(facts({ kind: "import", plan: "dataset" })).toContain("Kind of runImportOperator");
  });

  it("leads to the diagnosis where there is one, and to the run that it belongs to", () => {
    const always = ["Readings (CSV)", "History of this robot"];
    const ended_at = "2024-03-05T07:02:05Z";
    expect(links({ ended_at })).toEqual([
      "Certificate (HTML)",
      "Certificate (PDF)",
      "Certificate (JSON)",
      ...always,
    ]);
    // of what was not judged there is nothing to certify
    expect(links({ ended_at, state: "aborted", verdict: null })).toEqual(always);
    expect(links({ method: "diagnosis" })).toContain("Diagnosis");
    expect(links({ of: 4 })).toContain("Result 4");
  });

  it("gives the duration of a run that has ended", () => {
    const times = { started_at: "2024-03-05T07:00:00Z", ended_at: "2024-03-05T07:02:05Z" };
    expect(drawn(<RunFacts result={calibration(times)} />).textContent).toContain("2 min 05 s");
  });
});
