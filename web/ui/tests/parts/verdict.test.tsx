import { render } from "preact";
import { describe, expect, it } from "vitest";
import { VerdictLine, verdictOf } from "../../src/parts/verdict";
import { summary } from "../samples";

describe("the verdict", () => {
  it.each([
    ["succeeded", "pass", "PASS", ""],
    ["succeeded", "fail", "FAIL", "act"],
    ["succeeded", null, "NO VERDICT", "warn"],
    ["failed", "fail", "FAIL", "act"],
    ["failed", null, "FAILED", "act"],
    // a run that failed has passed nothing, whatever was written before
    ["failed", "pass", "FAILED", "act"],
    ["aborted", "pass", "ABORTED", "warn"],
    ["interrupted", null, "INTERRUPTED", "warn"],
    ["running", null, "RUNNING", ""],
    ["queued", null, "WAITING", ""],
  ] as const)("of a run that is %s with %s is %s", (state, verdict, word, alarm) =>
    expect(verdictOf({ state, verdict })).toMatchObject({ word, alarm }),
  );
});

describe("the line of a run", () => {
  const line = (given: Parameters<typeof summary>[0]) => {
    const place = document.createElement("div");
    render(<VerdictLine run={summary(given)} />, place);
    return place.textContent;
  };

  it("gives the reason", () => expect(line({ reason: "RMS 3 µm" })).toContain("RMS 3 µm"));
  it("gives the step of a run in progress", () =>
    expect(line({ state: "running", verdict: null, step: 2, steps: 8 })).toContain("step 2 of 8"));
  it("gives no step of a run that has ended", () =>
    expect(line({ step: 2, steps: 8 })).not.toContain("step"));
});
