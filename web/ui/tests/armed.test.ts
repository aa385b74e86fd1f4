import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { arm, armed, confirm, disarm, secondsLeft, watchArmed } from "../src/armed";
import { links, now, station } from "../src/live";
import { navigate } from "../src/router";
import { session } from "../src/session";
import type { SignedIn } from "../src/types";
import { run, stationNow, stopClock } from "./samples";

const confirmed = vi.fn();
let stop: () => void;

beforeEach(() => {
  confirmed.mockReset();
  navigate("/");
  stopClock();
  station.value = stationNow();
  session.value = signedIn("ada");
  stop = watchArmed();
  arm({}, confirmed);
});
afterEach(() => stop());

const signedIn = (name: string): SignedIn => ({
  name,
  role: "operator",
  via: "user",
  signs_off_after_s: null,
  sign_out_at: null,
});

describe("what waits for a confirmation", () => {
  it("is done once", () => {
    expect(confirm()).toBe(true);
    expect(confirm()).toBe(false);
    expect(confirmed).toHaveBeenCalledTimes(1);
  });

  it("is not done by what confirms another question", () => {
    expect(confirm({})).toBe(false);
    expect(confirmed).not.toHaveBeenCalled();
    expect(confirm(armed.value!.by)).toBe(true);
  });

  it("counts down ten seconds", () => {
    expect(secondsLeft.value).toBe(10);
    stop(); // a station that is silent for so long would be lost
    now.value += 9_500;
    expect(secondsLeft.value).toBe(1);
    now.value += 600;
    expect(secondsLeft.value).toBe(0);
  });

  it("is not done after its time, even where the page was too busy to withdraw it", () => {
    vi.spyOn(performance, "now").mockReturnValue(performance.now() + 11_000);
    expect(confirm()).toBe(false);
    expect(confirmed).not.toHaveBeenCalled();
  });

  it("outlives the first answer to who is there", () => {
    stop();
    session.value = undefined;
    stop = watchArmed();
    arm({}, confirmed);
    session.value = signedIn("ada");
    expect(armed.value).not.toBeNull();
  });

  it("is withdrawn by its owner only", () => {
    disarm({});
    expect(armed.value).not.toBeNull();
  });

  it.each([
    ["Escape", () => document.dispatchEvent(new KeyboardEvent("keydown", { key: "Escape" }))],
    ["hiding the tab", () => document.dispatchEvent(new Event("visibilitychange"))],
    ["leaving the page", () => dispatchEvent(new Event("pagehide"))],
    ["another view", () => navigate("/history")],
    ["another person", () => Object.assign(session, { value: signedIn("bo") })],
    ["signing off", () => Object.assign(session, { value: null })],
    ["a run that starts", () => Object.assign(station, { value: stationNow({ run: run() }) })],
    ["a feed that ends or begins", () => Object.assign(links, { value: links.value + 1 })],
    ["a lost connection", () => Object.assign(now, { value: now.value + 5_000 })],
  ])("is withdrawn by %s", (_, happens) => {
    happens();
    expect(armed.value).toBeNull();
    expect(confirm()).toBe(false);
  });
});
