import { render } from "preact";
import { beforeEach, describe, expect, it } from "vitest";
import { now, station } from "../../src/live";
import { Header } from "../../src/parts/header";
import { navigate } from "../../src/router";
import { session } from "../../src/session";
import type { Device, Station } from "../../src/types";
import { interlock, run, stationNow, stopClock } from "../samples";

const device = (state: Device["state"]): Device => ({
  name: "scale",
  kind: "scale",
  address: "a",
  state,
  text: "",
});
const door = interlock();

const drawn = () => {
  const place = document.createElement("div");
  render(<Header />, place);
  return place;
};
const status = (given: Partial<Station> | null) => {
  station.value = given && stationNow(given);
  return drawn().querySelector(".state strong")?.textContent;
};

beforeEach(() => {
  stopClock();
});

describe("the state of the station", () => {
  it("is the most urgent of all", () => {
    expect(status(null)).toBe("CONNECTING");
    expect(status({})).toBe("READY");
    expect(status({ interlocks: [door] })).toBe("◆ NOT READY");
    expect(status({ interlocks: [door], run: run() })).toBe("RUNNING");
    expect(status({ run: run({ state: "queued" }) })).toBe("QUEUED");
    expect(status({ run: run(), devices: [device("lost")] })).toBe("▲ scale: lost");
    expect(status({ devices: [device("fault")] })).toBe("▲ scale: fault");
    now.value += 60_000;
    expect(status({ run: run(), devices: [device("lost")] })).toBe("▲ OFFLINE");
    expect(drawn().textContent).toContain("values may be old");
  });

  it("says that a machine is emulated", () => {
    const info = stationNow().station;
    status({ station: { ...info, emulated: true } });
    expect(drawn().querySelector(".name")?.textContent).toBe("Cell 3 (emulated)");
    status({ station: info });
    expect(drawn().querySelector(".name")?.textContent).toBe("Cell 3");
  });
});

it.each([
  ["/", "Station"],
  ["/result/3", "Result"],
  ["/diagnosis/3?by=time", "Result"],
  ["/history?state=failed", "History"],
])("at %s the view %s is marked", (to, name) => {
  navigate(to, { replace: true });
  expect([...drawn().querySelectorAll("[aria-current=page]")].map((link) => link.textContent)).toEqual([
    name,
  ]);
});

it("says that nobody is signed in, not that the station is away", () => {
  session.value = null;
  now.value += 60_000;
  expect(status(null)).toBe("NOT SIGNED IN");
  expect(drawn().textContent).not.toContain("values may be old");
  session.value = undefined;
});
