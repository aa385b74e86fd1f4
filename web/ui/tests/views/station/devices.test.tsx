import { render } from "preact";
import { beforeEach, expect, it } from "vitest";
import { station } from "../../../src/live";
import { Devices } from "../../../src/views/station/devices";
import { interlock, stationNow, stopClock } from "../../samples";

const shown = () => {
  const place = document.createElement("div");
  render(<Devices />, place);
  return place.textContent;
};

beforeEach(() => {
  stopClock();
});

it("shows each interlock with its limits, its value and its last trip", () => {
  station.value = stationNow({
    interlocks: [
      interlock({
        id: "temperature",
        ok: true,
        limits: { low_c: 15, high_c: 30 },
        shows: "21.5 °C",
        last_trip: { run: 12, text: "too hot", stop_frame_ms: 3.1, standstill_ms: 41 },
      }),
      interlock({ id: "travel", ok: false, detail: "the rod slipped", limits: { error_mm: 60 } }),
    ],
  });
  const text = shown();
  expect(text).toContain("The temperature is within its window 15 … 30\u00a0°C");
  expect(text).toContain("21.5 °C");
  expect(text).toContain("Stopped run 12: stop frames sent after 3.1 ms, standstill seen after 41 ms");
  expect(text).toContain("≤\u00a060\u00a0mm");
  expect(text).toContain("the rod slipped");
});

it("shows the words of the station file in every language", () => {
  station.value = stationNow({
    interlocks: [interlock({ id: "guard_door", text: "Gate 4", own_text: true })],
  });
  expect(shown()).toContain("Gate 4");
});
