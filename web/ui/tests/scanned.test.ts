import { beforeEach, describe, expect, it, vi } from "vitest";
import type * as Api from "../src/api";
import { Refused } from "../src/api";
import { arm, armed, disarm } from "../src/armed";
import { station } from "../src/live";
import { operator } from "../src/operator";
import { navigate, path } from "../src/router";
import { notice, scanned, watchScans } from "../src/scanned";
import { badge, session } from "../src/session";
import { serial } from "../src/views/station/start";
import { stationNow, stopClock } from "./samples";

const codes = { serial: "[A-Z0-9-]{1,16}", badge: "BADGE:(.+)", confirm: "CONFIRM" };
const refused = vi.hoisted(() => vi.fn<typeof Api.refusedScan>());
vi.mock("../src/api", async (load) => ({
  ...(await load<typeof Api>()),
  refusedScan: refused,
  scanCodes: () => Promise.resolve(codes),
}));

const scan = (text: string, given = {}) => scanned({ text, readable: true, secret: false, ...given });
const confirmed = vi.fn();
const open = (is: boolean) => {
  const known = stationNow();
  station.value = { ...known, station: { ...known.station, open: is } };
};

describe("a scan", () => {
  beforeEach(async () => {
    refused.mockReset().mockResolvedValue(null);
    confirmed.mockReset();
    disarm();
    badge.value = null;
    serial.value = operator.value = "";
    session.value = {
      name: "ada",
      role: "operator",
      via: "open",
      signs_off_after_s: null,
      sign_out_at: null,
    };
    stopClock();
    open(true);
    navigate("/");
    watchScans();
    await Promise.resolve();
  });

  it("of a serial fills it in, on the station view", () => {
    navigate("/history?robot_serial=FB");
    scan("FB-7");
    expect([path.value, serial.value, notice.value]).toEqual(["/", "FB-7", null]);
  });

  it("of a badge signs on the operator where nobody signs in, else asks for the PIN", () => {
    scan("BADGE:Bo");
    expect([operator.value, badge.value]).toEqual(["Bo", null]);
    open(false);
    scan("BADGE:Cy");
    expect([operator.value, badge.value]).toEqual(["Bo", "BADGE:Cy"]);
  });

  it("of a badge fills the field for a new badge that has the focus, and signs nobody on", () => {
    open(false);
    document.body.innerHTML = "<input data-takes-badge><input>";
    const [field, other] = document.querySelectorAll("input");
    field!.focus();
    scan("BADGE:Cy");
    expect([field!.value, badge.value]).toEqual(["BADGE:Cy", null]);
    scan("FB-7");
    expect(field!.value).toBe("BADGE:Cy");
    other!.focus();
    scan("BADGE:Cy");
    expect([other!.value, badge.value]).toEqual(["", "BADGE:Cy"]);
    document.body.innerHTML = "";
  });

  it("of the code confirms what waits, and is refused where nothing does", () => {
    scan("CONFIRM");
    expect(refused).toHaveBeenCalledWith({ text: "CONFIRM", because: "nothing_to_confirm" });
    arm({}, confirmed);
    scan("CONFIRM");
    expect(confirmed).toHaveBeenCalledTimes(1);
    expect(notice.value).toBeNull();
  });

  it.each(["FB-7", "BADGE:Bo", "confirm", "http://x", "CONFIRM "])("of %j withdraws what waits", (text) => {
    arm({}, confirmed);
    scan(text);
    expect(armed.value).toBeNull();
    expect(confirmed).not.toHaveBeenCalled();
  });

  it("of anything else is refused, shown and told to the station, cut and without control characters", async () => {
    scan(`a\u0007 b${"c".repeat(100)}`);
    expect(notice.value?.text).toMatch(/^Not a serial: a/);
    expect(notice.value?.refused).toBe(true);
    expect(refused).toHaveBeenCalledWith({ text: `a b${"c".repeat(61)}`, because: "unknown" });
    expect(serial.value).toBe("");
  });

  it("that could not be read completely is refused, also where the rest is a serial", () => {
    scan("FB-7", { readable: false });
    expect(serial.value).toBe("");
    expect(refused).toHaveBeenCalledWith({ text: "FB-7", because: "unreadable" });
  });

  it("where a secret is typed is neither shown nor kept", () => {
    scan("hunter2 ", { secret: true });
    expect(notice.value?.text).not.toContain("hunter2");
    expect(refused).toHaveBeenCalledWith({ text: "", because: "unknown" });
  });

  it("of a serial is refused while nobody is signed in", () => {
    session.value = null;
    scan("FB-7");
    expect(serial.value).toBe("");
    expect(notice.value?.refused).toBe(true);
  });

  it("waits for the station to say who is signed in, and confirms nothing then", () => {
    const known = session.value;
    session.value = undefined;
    scan("FB-7");
    expect([serial.value, notice.value]).toEqual(["", null]);
    session.value = known;
    expect(serial.value).toBe("FB-7");
  });

  it("of the code that came before the question does not answer it", async () => {
    vi.resetModules();
    const fresh = await import("../src/scanned");
    const { arm: ask, armed: question } = await import("../src/armed");
    const { session: who } = await import("../src/session");
    fresh.scanned({ text: "CONFIRM", readable: true, secret: false });
    ask({}, confirmed);
    who.value = session.value;
    fresh.watchScans();
    await vi.waitFor(() => expect(fresh.notice.value?.refused).toBe(true));
    expect([question.value, confirmed.mock.calls]).toEqual([null, []]);
  });

  it("is refused when the station says nothing for three seconds", () => {
    vi.useFakeTimers();
    const known = session.value;
    session.value = undefined;
    scan("FB-7");
    vi.advanceTimersByTime(2999);
    expect(notice.value).toBeNull();
    vi.advanceTimersByTime(1);
    expect(notice.value).toMatchObject({ refused: true });
    session.value = known;
    expect(serial.value).toBe("");
    vi.useRealTimers();
  });

  it("that was refused while the station did not respond is told later, others are not repeated", async () => {
    refused.mockRejectedValueOnce(new Refused("No answer."));
    scan("a b");
    await vi.waitFor(() => expect(refused).toHaveBeenCalledTimes(1));
    refused.mockRejectedValueOnce(new Refused("Forbidden.", null, 403));
    scan("c d");
    await vi.waitFor(() => expect(refused).toHaveBeenCalledTimes(3));
    expect(refused.mock.calls.map(([one]) => one.text)).toEqual(["a b", "a b", "c d"]);
  });
});
