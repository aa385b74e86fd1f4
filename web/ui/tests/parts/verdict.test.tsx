import { render } from "preact";
import { describe, expect, it } from "vitest";
import { outcomeOf, VerdictLine } from "../../src/parts/verdict";
import { summary } from "../samples";

describe("how a run ended", () => {
  it.each([
    ["succeeded", "pass", "good", "GOOD", "", "PASS"],
    ["succeeded", "fail", "repair", "REPAIR", "warn", "FAIL"],
    // a defect is never a pass, whatever the verdict
    ["succeeded", "pass", "repair", "REPAIR", "warn", ""],
    ["succeeded", "fail", "ambiguous", "NOT CERTAIN", "warn", "FAIL"],
    ["succeeded", "fail", "unexplained", "UNEXPLAINED", "act", "FAIL"],
    ["succeeded", "fail", "not_accurate_enough", "NOT ACCURATE ENOUGH", "warn", "FAIL"],
    ["succeeded", "fail", "not_verified", "NOT VERIFIED", "warn", "FAIL"],
    ["succeeded", "fail", "failed", "FAILED", "act", "FAIL"],
    // nothing is good that did not pass
    ["succeeded", "fail", "good", "FAIL", "act", ""],
    ["succeeded", null, "good", "NO VERDICT", "warn", ""],
    ["failed", "pass", "good", "FAILED", "act", ""],
    ["failed", "fail", "failed", "FAILED", "act", ""],
    ["aborted", "pass", "good", "ABORTED", "warn", ""],
    ["interrupted", null, "interrupted", "INTERRUPTED", "warn", ""],
    ["running", null, null, "RUNNING", "", ""],
    ["queued", null, null, "QUEUED", "", ""],
  ] as const)("%s with %s and %s is %s", (state, verdict, outcome, word, alarm, beside) =>
    expect(outcomeOf({ state, verdict, outcome })).toMatchObject({ word, alarm, verdict: beside }),
  );

  it.each([
    ["succeeded", "pass", "PASS", ""],
    ["succeeded", "fail", "FAIL", "act"],
    ["succeeded", null, "NO VERDICT", "warn"],
    ["failed", "pass", "FAILED", "act"],
  ] as const)("without an outcome, %s with %s is %s", (state, verdict, word, alarm) =>
    expect(outcomeOf({ state, verdict })).toMatchObject({ word, alarm, verdict: "" }),
  );
});

describe("the line of a run", () => {
  const line = (given: Parameters<typeof summary>[0]) => {
    const place = document.createElement("div");
    render(<VerdictLine run={summary(given)} />, place);
    return place.textContent;
  };

  it("gives the reason", () => expect(line({ reason: "RMS 3 µm" })).toContain("RMS 3 µm"));
  it("gives outcome and verdict", () => expect(line({})).toContain("GOOD Verdict: PASS"));
  it("gives the step of a run in progress", () =>
    expect(line({ state: "running", verdict: null, step: 2, steps: 8 })).toContain("step 2 of 8"));
  it("gives no step of a run that has ended", () =>
    expect(line({ step: 2, steps: 8 })).not.toContain("step"));
});
