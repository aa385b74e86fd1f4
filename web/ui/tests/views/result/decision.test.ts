import { describe, expect, it, vi } from "vitest";
import type { Calibration } from "../../../src/types";
import { decisionOf, isValid } from "../../../src/views/result/decision";
import { calibration, finding } from "../../samples";

const line = (given: Partial<Calibration>) => {
  const { look, sentence } = decisionOf(calibration(given));
  // values do not break before their units
  return `${look.word}: ${sentence}`.replaceAll("\u00a0", " ");
};
const accuracy = (bound_95_mm: number | null, wanted_mm: number | null) => ({
  bound_95_mm,
  bound_95_model_mm: null,
  wanted_mm,
  reached: null,
  stopped_because: null,
  stopped_because_said: null,
});

describe("the decision", () => {
  it("compares the bound with the limit, and names both", () => {
    expect(line({ accuracy: accuracy(0.31, 0.5) })).toBe(
      "GOOD: position error at most 0.310 mm (95 %), limit 0.500 mm",
    );
    expect(line({ accuracy: accuracy(0.31, null) })).toBe(
      "GOOD: position error at most 0.310 mm (95 %), no limit was given",
    );
    expect(line({ accuracy: accuracy(0.62, 0.5), verdict: "fail", outcome: "not_accurate_enough" })).toBe(
      "NOT ACCURATE ENOUGH: position error at most 0.620 mm (95 %), limit 0.500 mm",
    );
  });

  it("is never good over a limit that is not kept, whatever the record says", () => {
    expect(line({ accuracy: accuracy(0.50004, 0.5) })).toBe(
      "NOT ACCURATE ENOUGH: position error at most 0.50004 mm (95 %), limit 0.50000 mm",
    );
    expect(line({ accuracy: accuracy(null, 0.5), reason: "No accuracy can be promised." })).toBe(
      "NOT ACCURATE ENOUGH: No accuracy can be promised.",
    );
  });

  it("names the defect and its size, and says nowhere that it passed", () => {
    const repair: Partial<Calibration> = { outcome: "repair", findings: [finding()] };
    for (const verdict of ["pass", "fail"] as const) {
      expect(line({ ...repair, verdict })).toBe("REPAIR: Backlash of joint 2, 0.04960 ± 0.00020 °");
    }
    const two = [finding(), finding({ joint: 1, label: "backlash of joint 1", parameters: [] })];
    expect(line({ ...repair, verdict: "fail", findings: two })).toMatch(
      /^REPAIR: .* and backlash of joint 1$/,
    );
    expect(line({ ...repair, verdict: "fail", findings: [], reason: "It broke." })).toBe("REPAIR: It broke.");
  });

  it("names what cannot be distinguished", () => {
    const reason_params = {
      causes: "gear_cyclic of joint 1",
      probability_percent: 71.4,
      others: "drift (20 %)",
      experiment: "",
    };
    expect(line({ verdict: "fail", outcome: "ambiguous", reason_code: "ambiguous", reason_params })).toBe(
      "NOT CERTAIN: Gear ripple of joint 1 (71 %) or drift (20 %)",
    );
    // of older versions there is only the sentence
    expect(line({ verdict: "fail", outcome: "ambiguous", reason: "Not certain: drift or a bend." })).toBe(
      "NOT CERTAIN: Drift or a bend.",
    );
  });

  it("is the sentence of the service until the phrases in it are loaded", () => {
    const reason_params = {
      causes: "gear_cyclic of joint 1",
      probability_percent: 71.4,
      others: { code: "share", params: { causes: "unnamed error by place", percent: 20 } },
      experiment: "",
    };
    const reason = "Not certain: gear ripple or a bend.";
    expect(
      line({ verdict: "fail", outcome: "ambiguous", reason_code: "ambiguous", reason, reason_params }),
    ).toBe("NOT CERTAIN: Gear ripple or a bend.");
  });

  it("does not say the same word twice, in any language", async () => {
    const unexplained: Partial<Calibration> = { verdict: "fail", outcome: "unexplained" };
    expect(line({ ...unexplained, reason: "Unexplained: the residual is not noise." })).toBe(
      "UNEXPLAINED: The residual is not noise.",
    );
    vi.resetModules();
    localStorage.setItem("language", "zh");
    const chinese = (await import("../../../src/views/result/decision")).decisionOf(
      calibration({ ...unexplained, reason: "未解释：残差不是噪声。" }),
    );
    expect([chinese.look.word, chinese.sentence]).toEqual(["未解释", "残差不是噪声。"]);
    localStorage.clear();
  });

  it("gives the reason of a run that did not come to its end, and the step of one in progress", () => {
    expect(line({ state: "aborted", verdict: null, outcome: "aborted", reason: "Stopped by ada." })).toBe(
      "ABORTED: Stopped by ada.",
    );
    expect(line({ state: "interrupted", verdict: null, outcome: "interrupted" })).toMatch(
      /^INTERRUPTED: The/,
    );
    expect(line({ state: "failed", verdict: null, reason: "No answer." })).toBe("FAILED: No answer.");
    expect(line({ state: "running", verdict: null, outcome: null, step: 2, steps: 8 })).toBe(
      "RUNNING: step 2 of 8",
    );
  });

  it("says what readings mean that no robot gives, not what the solver calls its unknowns", () =>
    expect(
      line({
        verdict: "fail",
        outcome: "failed",
        reason_code: "not_identified",
        reason: "rMx is 43 times off.",
      }),
    ).toBe("FAILED: no robot within its tolerances gives these readings"));
});

describe("numbers", () => {
  it("are valid only of a run that was accepted", () => {
    expect(isValid(calibration())).toBe(true);
    for (const given of [
      { verdict: "fail" },
      { verdict: null },
      { outcome: "repair" },
      { outcome: null },
      { state: "failed" },
      { accuracy: accuracy(0.6, 0.5) },
    ] as Partial<Calibration>[]) {
      expect(isValid(calibration(given))).toBe(false);
    }
  });
});
