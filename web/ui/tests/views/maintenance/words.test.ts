import { describe, expect, it } from "vitest";
import type { AuditEntry, Exercise, WireExchange } from "../../../src/types";
import { change } from "../../../src/views/maintenance/audit";
import { inWords as said, wrongWith } from "../../../src/views/maintenance/exercises";
import { inWords } from "../../../src/views/maintenance/wire";

const exchange: WireExchange = {
  at_s: 1,
  device: "drive 2",
  action: "read",
  subject: "position, pulses",
  answer: "602Ch = 7",
  angle_deg: 12.3456,
  took_ms: 4,
  beside: false,
};

describe("the wire log", () => {
  it("says a position as an angle", () =>
    expect(inWords(exchange)).toBe("Asked drive 2 for its position: 12.346°"));

  it("says what was written, and that nothing came", () =>
    expect(
      inWords({
        ...exchange,
        action: "write",
        subject: "trigger",
        angle_deg: null,
        took_ms: null,
        beside: true,
      }),
    ).toBe("Wrote to drive 2: trigger → ▲ no reply (not by the run itself)"));

  it("expects no reply to what has none", () =>
    expect(inWords({ ...exchange, device: "scale", action: "other", angle_deg: null, took_ms: null })).toBe(
      "Sent to the scale: position, pulses → –",
    ));

  it("names a line that broke or could not be opened", () => {
    expect(inWords({ ...exchange, action: "broken", answer: "gone" })).toBe("▲ The line broke: gone");
    expect(inWords({ ...exchange, action: "refused", answer: "busy" })).toContain(
      "could not be opened: busy",
    );
  });
});

const entry: AuditEntry = {
  n: 3,
  at: "2026-11-27T08:00:00Z",
  who: "Ada",
  via: "user",
  role: "administrator",
  action: "setting.changed",
  subject: "setting limits.speed_deg_s",
  before: { value: "20" },
  after: { value: "25" },
  hash: "",
};

describe("the audit", () => {
  it("says what has changed", () => {
    expect(change(entry)).toContain("value 20");
    expect(change({ ...entry, before: null, after: { role: "viewer", until: null } })).toBe("role viewer");
    expect(change({ ...entry, before: null, after: null })).toBe("");
  });
});

const exercise: Exercise = {
  n: 1,
  unseen: true,
  revealed: true,
  challenge: {
    kind: "backlash",
    group: "catalogue",
    joint: true,
    unit: "deg",
    smallest: 0.01,
    usual: 0.05,
    largest: 0.1,
  },
  joint: 2,
  size: 0.06,
  repaired: false,
  said: null,
  score: null,
};
const ended = {
  run: 4,
  state: "succeeded" as const,
  verdict: null,
  outcome: "repair" as const,
  reason: "The scale does not answer.",
  diagnosis: null,
  confirmed: null,
  causes: [],
};

describe("an exercise", () => {
  it("is what was wrong, by its display name", () =>
    expect(wrongWith(exercise)).toBe("Backlash, joint 2, 0.06 °"));

  it("is not shown before it is revealed", () =>
    expect(wrongWith({ ...exercise, challenge: null })).toBe("not shown"));

  it("says what the run found, or why it ended", () => {
    expect(said(exercise)).toBe("");
    expect(said({ ...exercise, said: ended })).toBe("The scale does not answer.");
    const causes = [{ effect: "backlash", joint: 2, part: null, probability: 0.993 }];
    expect(said({ ...exercise, said: { ...ended, diagnosis: "explained", causes } })).toMatch(
      /Backlash of joint 2 \(> 99 %\)$/,
    );
    expect(said({ ...exercise, said: { ...ended, diagnosis: "unexplained" } })).toMatch(/no cause$/);
  });
});
