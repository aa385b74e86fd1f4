import { describe, expect, it } from "vitest";
import { t } from "../../../src/messages";
import type { Diagnosis } from "../../../src/types";
import { causeOrdering } from "../../../src/views/diagnosis/cause-ordering";
import { ORDERINGS, orderingsOf } from "../../../src/views/diagnosis/orderings";
import { diagnosed, finding, row } from "../../samples";

const nothing = { findings: [], explanations: [], hints: [] };
const opens = (given: Partial<Diagnosis>, orderings = ORDERINGS) =>
  causeOrdering(diagnosed({ ...nothing, ...given }), orderings).id;
const effect = (name: string, joint: number | null = null) =>
  opens({ findings: [finding({ effect: name, joint })] });

describe("the ordering that a diagnosis opens on", () => {
  it.each([
    ["backlash", 2, "approach2"],
    ["gear_cyclic", 1, "joint1"],
    ["drift", null, "time"],
    ["scale_bow", null, "travel"],
    ["link_length", null, "position"],
    ["thermal_growth", null, "temperature"],
  ])("of %s, joint %s is %s", (name, joint, id) => expect(effect(name, joint)).toBe(id));

  it("is known for every effect of the catalogue", () => {
    // one that could not be shown would open on the first ordering by mistake
    const others = Object.keys(t.effects).filter((id) => id !== "unnamed");
    const first = others.filter((id) => effect(id, 2) === ORDERINGS[0]!.id);
    expect(first.toSorted()).toEqual(["count_slip", "drift"]);
  });

  it("is one that these readings have", () => {
    const orderings = orderingsOf([row()]);
    expect(opens({ findings: [finding({ effect: "thermal_growth" })] }, orderings)).toBe("time");
  });

  it("is that of the most probable explanation where nothing is reported", () => {
    const unnamed = (depends_on: string, probability: number) => ({
      effects: [{ ...finding(), effect: "unnamed", depends_on }],
      probability,
      named: false,
    });
    const explanations = [unnamed("time", 0.2), unnamed("joint2", 0.8)] as Diagnosis["explanations"];
    expect(opens({ explanations })).toBe("joint2");
  });

  it("is what the residual depends on most where there is no explanation either", () => {
    const hints = [
      { depends_on: "theta1", strength: 0.3, text: "", said: null },
      { depends_on: "approach x place", strength: 0.6, text: "", said: null },
    ];
    expect(opens({ hints })).toBe("approach1");
    expect(opens({ hints: [{ depends_on: "theta2", strength: 1, text: "", said: null }] })).toBe("joint2");
    expect(opens({})).toBe(ORDERINGS[0]!.id);
  });
});
