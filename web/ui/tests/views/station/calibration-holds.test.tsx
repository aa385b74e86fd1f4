import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, it, vi } from "vitest";
import type * as Api from "../../../src/api";
import { station } from "../../../src/live";
import { CalibrationHolds } from "../../../src/views/station/calibration-holds";
import { stationNow, stopClock, summary } from "../../samples";

const asked = vi.hoisted(() => vi.fn<typeof Api.calibrationHolds>());
vi.mock("../../../src/api", async (load) => ({ ...(await load<typeof Api>()), calibrationHolds: asked }));

const FREE = {
  robot_serial: "FB-1",
  locked: false,
  text: "Not checked yet.",
  check: null,
  calibration_valid_until: null,
};

it("shows the lock as soon as the check that failed has ended, without a new snapshot", async () => {
  stopClock();
  const place = document.createElement("div");
  asked.mockResolvedValueOnce(FREE);
  station.value = stationNow({ calibration: FREE, last: summary({ id: 1 }) });
  await act(async () => render(<CalibrationHolds />, place));
  expect(place.querySelector("section")!.hidden).toBe(true);
  asked.mockResolvedValueOnce({ ...FREE, locked: true, check: 2, text: "Locked: check 2 failed. It moved." });
  await act(async () => {
    station.value = { ...station.value!, last: summary({ id: 2, kind: "check" }) };
  });
  await act(() => new Promise((later) => setTimeout(later, 10)));
  expect(place.querySelector("section")!.hidden).toBe(false);
  expect(place.textContent).toContain("Locked: check 2 failed.");
});
