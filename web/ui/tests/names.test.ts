import { describe, expect, it } from "vitest";
import { effectName, labelName, methodName, parameter, runKind, shown, stageName } from "../src/names";

describe("effects", () => {
  it("have a display name, with the joint where they belong to one", () => {
    expect(effectName({ effect: "gear_cyclic", joint: 1 })).toBe("gear ripple of joint 1");
    expect(effectName({ effect: "drift", joint: null })).toBe("drift");
  });

  it.each([
    ["backlash of joint 2", "backlash of joint 2"],
    ["gear_cyclic of joint 1", "gear ripple of joint 1"],
    ["gear_cyclic curve of joint 3", "gear ripple curve of joint 3"],
    ["link_length L1", "length error of proximal link 1"],
    ["link_length l2", "length error of distal link 2"],
    ["thermal_growth", "thermal growth"],
    ["thermal_growth of the links", "thermal growth of the links"],
    ["a_new_effect of joint 2", "a new effect of joint 2"],
    ["something else, entirely", "something else, entirely"],
  ])("the label %s reads %s", (label, name) => expect(labelName(label)).toBe(name));

  it.each([
    ["paper", "published model"],
    ["base", "base model"],
    ["+ gear_cyclic of joint 1", "+ gear ripple of joint 1"],
  ])("the stage %s reads %s", (model, name) => expect(stageName(model)).toBe(name));
});

describe("parameters", () => {
  it.each([
    ["rMx", "mounting error of the mechanism, x"],
    ["rMy@left", "mounting error of the mechanism, y left"],
    ["L1", "length error of proximal link 1"],
    ["l2", "length error of distal link 2"],
    ["rho0@left", "reading offset left"],
    ["beta3", "parallelism error of joint 3"],
    ["tool_x", "tool position x"],
    ["base_rz", "base rotation z"],
    ["e1x", "error in x of base joint 1"],
    ["dtheta2", "zero offset 2"],
    ["amplitude_2_deg", "amplitude 2"],
    ["per_rev_3", "cycles per revolution 3"],
    ["deg_at_full_reach", "sag at full reach"],
    ["not_known_yet", "not known yet"],
  ])("%s reads %s", (id, name) => expect(parameter(id).name).toBe(name));

  it("are not mistaken for what every object has", () =>
    expect(parameter("constructor").name).toBe("constructor"));

  it("that are errors of a reading are shown in µm", () => {
    const amplitude = shown({ name: "amplitude_mm", value: 0.0021, sd: 0.0001, unit: "mm" });
    expect(amplitude).toMatchObject({ value: 2.1, sd: 0.1, unit: "µm" });
    expect(shown({ name: "mm_per_hour", value: 0.05, sd: null, unit: "mm/h" })).toMatchObject({
      value: 50,
      sd: null,
      unit: "µm/h",
    });
  });

  it("that are lengths stay in mm, and angles are in °", () => {
    expect(shown({ name: "period_mm", value: 2, sd: 0.1, unit: "mm" })).toMatchObject({
      value: 2,
      unit: "mm",
    });
    expect(shown({ name: "width_deg", value: 0.05, sd: 0.1, unit: "deg" })).toMatchObject({
      value: 0.05,
      unit: "°",
    });
    expect(shown({ name: "per_rev", value: 20, sd: 0.1, unit: "1/rev" }).unit).toBe("");
  });
});

it("runs are named by their plan, or by what else they are", () => {
  expect(runKind("diagnostic").name).toBe("Find the cause");
  expect(runKind("separating").name).toBe("Separating experiment");
  expect(runKind("new_kind").name).toBe("new kind");
});

it("methods that are not known are shown as the service states them", () => {
  expect(methodName("published")).toBe("Published method");
  expect(methodName("zero offsets of run 4")).toBe("zero offsets of run 4");
});
