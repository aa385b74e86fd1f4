import { beforeEach, expect, it } from "vitest";
import { said, wishes } from "../../../src/views/station/wishes";

beforeEach(() => {
  for (const [name, field] of Object.entries(wishes)) field.value = name === "joint" ? "1" : "";
});

it("asks for nothing while nothing is typed in", () => {
  expect(said()).toEqual({ body: {}, wrong: null });
});

it("says accuracy and references as the service wants them", () => {
  wishes.accuracy.value = "0,2";
  wishes.joint.value = "2";
  wishes.at.value = "180";
  wishes.reads.value = "180.012";
  wishes.sd.value = "0.005";
  wishes.mounting.value = "1.02";
  wishes.mountingSd.value = "0.02";
  expect(said()).toEqual({
    body: {
      until_mm: 0.2,
      references: [
        { kind: "joint_angle", joint: 2, at_deg: 180, reads_deg: 180.012, sd_deg: 0.005 },
        { kind: "drm_x", value_mm: 1.02, sd_mm: 0.02 },
      ],
    },
    wrong: null,
  });
});

it("names what is no number or left half empty", () => {
  wishes.accuracy.value = "fine";
  expect(said().wrong).toBe("accuracy");
  wishes.accuracy.value = "";
  wishes.reads.value = "0.1";
  expect(said().wrong).toBe("at");
});
