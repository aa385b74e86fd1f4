import { describe, expect, it } from "vitest";
import {
  dependence,
  effectName,
  labelName,
  methodName,
  parameter,
  planOf,
  readable,
  runKind,
  shown,
  stageName,
} from "../src/names";

describe("effects", () => {
  it("have a display name, with the joint where they belong to one", () => {
    expect(effectName({ effect: "gear_cyclic", joint: 1 })).toBe("Gear ripple of joint 1");
    expect(effectName({ effect: "drift", joint: null })).toBe("Drift");
  });

  it("have the part on which they act", () => {
    expect(effectName({ effect: "link_length", joint: 1, part: "L1" })).toBe(
      "Link length error of proximal link 1",
    );
    expect(effectName({ effect: "thermal_growth", joint: null, part: "links" })).toBe(
      "Thermal growth of the links",
    );
    expect(effectName({ effect: "gear_cyclic", joint: 1, part: null })).toBe("Gear ripple of joint 1");
    expect(effectName({ effect: "backlash", joint: 2, part: "joint2" })).toBe("Backlash of joint 2");
    expect(effectName({ effect: "drift", joint: null, part: "a new part" })).toBe("Drift of a new part");
  });

  it("have it by their label where that alone has it", () =>
    expect(effectName({ effect: "link_length", joint: 1, label: "link_length l1" })).toBe(
      "Link length error of distal link 1",
    ));

  it("without a name are called after what they depend on", () =>
    expect(effectName({ effect: "unnamed", joint: null, depends_on: "joint1" })).toBe(
      "Unnamed error that depends on the angle of joint 1",
    ));

  it.each([
    ["backlash of joint 2", "Backlash of joint 2"],
    ["gear_cyclic of joint 1", "Gear ripple of joint 1"],
    ["gear_cyclic curve of joint 3", "Gear ripple curve of joint 3"],
    ["link_length L1", "Link length error of proximal link 1"],
    ["link_length l2", "Link length error of distal link 2"],
    ["thermal_growth", "Thermal growth"],
    ["thermal_growth of the links", "Thermal growth of the links"],
    ["a_new_effect of joint 2", "A new effect of joint 2"],
    ["something else, entirely", "Something else, entirely"],
  ])("the label %s reads %s", (label, name) => expect(labelName(label)).toBe(name));

  it.each([
    ["paper", "Published model"],
    ["base", "Base model"],
    ["+ gear_cyclic of joint 1", "+ gear ripple of joint 1"],
    ["+ drift and unnamed error by place", "+ drift and unnamed error by position"],
  ])("the stage %s reads %s", (model, name) => expect(stageName(model)).toBe(name));
});

describe("a sentence of the service", () => {
  it.each([
    ["gear_cyclic of joint 1 explained 99.0 %.", "Gear ripple of joint 1 explained 99.0 %."],
    [
      "Not link_length L1 but link_length l2.",
      "Not link length error of proximal link 1 but link length error of distal link 2.",
    ],
    [
      "gear cyclic of joint 2 and scale_gain were found",
      "Gear ripple of joint 2 and scale gain error were found",
    ],
    ["thermal_growth of the links took most.", "Thermal growth of the links took most."],
    ["compliance of joint 1 is left", "Sag under gravity of joint 1 is left"],
    ["Use the plan `full`.", "Use the plan Full."],
    // as it is, where it has display names already
    ["Link length error of proximal link 1.", "Link length error of proximal link 1."],
    ["Scale gain error and thermal growth.", "Scale gain error and thermal growth."],
    // words of the language stay as they are
    ["Reduce the compliance of the bracket.", "Reduce the compliance of the bracket."],
    ["The link length is nominal.", "The link length is nominal."],
  ])("%s reads %s", (text, read) => expect(readable(text)).toBe(read));
});

it.each([
  ["theta2", "the angle of joint 2"],
  ["approach x place", "the direction of approach and the position"],
  ["time", "time"],
  ["the phase of the moon", "the phase of the moon"],
])("a dependence on %s reads %s", (on, words) => expect(dependence(on)).toBe(words));

describe("parameters", () => {
  it.each([
    ["rMx", "Mounting error of the mechanism, sideways"],
    ["rMy@left", "Mounting error of the mechanism, in height (mount left)"],
    ["L1", "Length error of proximal link 1"],
    ["l2", "Length error of distal link 2"],
    ["rho0@left", "Offset of the readout (mount left)"],
    ["beta3", "Parallelism error of joint 3"],
    ["tool_x", "Tool position, x"],
    ["base_rz", "Base rotation, z"],
    ["e1x", "Error in x of base joint 1"],
    ["dtheta2", "Zero offset of joint 2"],
    ["amplitude_2_deg", "Amplitude 2"],
    ["per_rev_3", "Cycles per turn 3"],
    ["deg_at_full_reach", "Sag at full reach"],
    ["not_known_yet", "Not known yet"],
  ])("%s reads %s", (id, name) => expect(parameter(id).name).toBe(name));

  it("are not mistaken for what every object has", () =>
    expect(parameter("constructor").name).toBe("Constructor"));

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

it("runs are named by what they do, and by the plan of those that have one", () => {
  expect(runKind("separate").name).toBe("Further diagnosis");
  expect(runKind("new_kind").name).toBe("New kind");
  expect(planOf("diagnostic")?.name).toBe("Diagnostic");
  expect(planOf("dataset")).toBeUndefined();
});

it("methods that are not known are shown as the service states them", () => {
  expect(methodName("published")).toBe("Published method");
  expect(methodName("zero offsets of run 4")).toBe("zero offsets of run 4");
});
