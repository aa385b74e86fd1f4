import { describe, expect, it } from "vitest";
import { t } from "../src/messages";
import { loadPhrases } from "../src/messages/phrases";
import { reasonText } from "../src/reason";
import { formatted } from "../src/template";

describe("a template", () => {
  // as Python's str.format fills it
  it.each([
    ["{x}", 7, "7"],
    ["{x}", "A1", "A1"],
    ["{x}", 0.25, "0.25"],
    ["{x:.1f}", 0.9412, "0.9"],
    ["{x:.4f}", 1, "1.0000"],
    ["{x:.0f}", 12.6, "13"],
    ["{x:+.1f}", 100.04, "+100.0"],
    ["{x:+.1f}", -100.04, "−100.0"],
    ["{x:.1g}", 0.00031, "0.0003"],
    ["{x:.1g}", 0.000031, "3e-05"],
    ["{x:.1g}", 0, "0"],
    ["{x:.1g}", 0.2, "0.2"],
    ["{x:.1g}", 0.96, "1"],
    ["{x:.1g}", 12, "1e+01"],
    ["{x:.3g}", 1.5, "1.5"],
    ["{x:.3g}", 100, "100"],
    ["{x:.2g}", 1e-120, "1e-120"],
    ["{x:.2g}", -0.5, "-0.5"],
  ])("%s of %s is %s", (template, x, text) => expect(formatted(template, { x })).toBe(text));

  it("is filled with every value", () =>
    expect(formatted("{a} of {b:.1f} µm, {a}", { a: 2, b: 3 })).toBe("2 of 3.0 µm, 2"));

  it.each([
    ["{x}", {}],
    ["{constructor}", {}],
    ["{x:.1f}", { x: "3" }],
    ["{x:.1f}", { x: Number.NaN }],
  ])("%s is not filled from %o", (template, params) => expect(formatted(template, params)).toBeNull());

  it("of every reason has no field that cannot be filled", () => {
    for (const template of Object.values(t.reasons)) {
      const names = [...template.matchAll(/\{(\w+)/g)].map(([, name]) => name!);
      expect(formatted(template, Object.fromEntries(names.map((name) => [name, 1])))).not.toMatch(/[{}]/);
    }
  });
});

describe("a reason", () => {
  const reason = "As the service words it.";

  it("is worded by the page from its code", () =>
    expect(reasonText({ reason, reason_code: "verified", reason_params: { rms_um: 3.14 } })).toBe(
      "Verified: fresh readings agree within 3.1 µm.",
    ));

  it("has display names for effects and dependences", () => {
    const reason_params = {
      causes: "gear_cyclic of joint 1 and link_length L2",
      share_percent: 91.2,
      depends_on: "theta2",
    };
    expect(reasonText({ reason, reason_code: "partly_explained", reason_params })).toBe(
      "Gear ripple of joint 1 and link length error of proximal link 2 explained 91.2 % of the residual; " +
        "the remaining residual depends on the angle of joint 2.",
    );
  });

  it.each([
    ["of an older version", null, {}],
    ["unknown to the page", "brand_new", { x: 1 }],
    ["of what every object has", "constructor", {}],
    ["without a value", "verified", {}],
  ] as const)("%s is the sentence of the service", (_, reason_code, reason_params) =>
    expect(reasonText({ reason, reason_code, reason_params: { ...reason_params } })).toBe(reason),
  );

  it("with a phrase in it is said once the phrases are loaded, until then by the service", async () => {
    const text = { code: "in_fresh_file", params: { mistake: { code: "approach_missing", params: {} } } };
    const run = { reason, reason_code: "adequate_mistake", reason_params: { text } };
    expect(reasonText(run)).toBe(reason);
    await loadPhrases();
    expect(reasonText(run)).toMatch(
      /^The model fits .*: Fresh file: Columns approach1 and approach2 are missing/,
    );
  });

  it("that the service words has display names, too", () =>
    expect(reasonText({ reason: "gear_cyclic of joint 1 explained all." })).toBe(
      "Gear ripple of joint 1 explained all.",
    ));

  it("is nothing where there is none", () => expect(reasonText({ reason: null })).toBeNull());
});
