import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { LiveEvent, LiveMessage, Station } from "../src/types";
import { interlock as lock, reading, run, stationNow, summary } from "./samples";

/** The service's end of a socket. */
class FakeSocket {
  static all: FakeSocket[] = [];
  onmessage: ((event: { data: string }) => void) | null = null;
  onclose: (() => void) | null = null;
  closed = false;

  constructor(readonly url: string) {
    FakeSocket.all.push(this);
  }

  static get latest(): FakeSocket {
    return FakeSocket.all.at(-1)!;
  }

  close(): void {
    this.closed = true;
    this.onclose?.();
  }

  send(event: LiveEvent, number: number, build = "b1"): void {
    const message: LiveMessage = { ...event, number, at: "2024-03-05T07:00:00.000Z", build };
    this.onmessage?.({ data: JSON.stringify(message) });
  }

  snapshot(data: Partial<Station> = {}, number = 10, build = "b1"): void {
    this.send({ type: "snapshot", data: stationNow(data) }, number, build);
  }

  beat(number: number, build = "b1"): void {
    this.send({ type: "beat", data: null }, number, build);
  }
}

let live: typeof import("../src/live");
const reload = vi.fn();

beforeEach(async () => {
  vi.useFakeTimers();
  FakeSocket.all = [];
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.spyOn(location, "reload").mockImplementation(reload);
  reload.mockClear();
  vi.resetModules();
  live = await import("../src/live");
  live.connect();
});

afterEach(() => {
  vi.clearAllTimers();
  vi.useRealTimers();
});

describe("a snapshot", () => {
  it("is asked of the host that serves the page", () =>
    expect(FakeSocket.latest.url).toBe(`ws://${location.host}/api/v1/live`));

  it("makes the page connected", () => {
    expect(live.connected.value).toBe(false);
    FakeSocket.latest.snapshot();
    expect(live.connected.value).toBe(true);
    expect(live.station.value?.station.name).toBe("Cell 3");
  });

  it("sets the clock to the service's", () => {
    FakeSocket.latest.snapshot();
    expect(live.clock.value.toISOString()).toBe("2024-03-05T07:00:00.000Z");
    vi.advanceTimersByTime(1000);
    expect(live.clock.value.toISOString()).toBe("2024-03-05T07:00:01.000Z");
  });

  it("replaces everything that was known", () => {
    FakeSocket.latest.snapshot({ run: run() });
    FakeSocket.latest.snapshot({ run: null }, 99);
    expect(live.station.value?.run).toBeNull();
  });
});

describe("numbered events", () => {
  const events = (...given: LiveEvent[]) => {
    FakeSocket.latest.snapshot({ run: run({ stops: twice("A") }) });
    given.forEach((event, k) => {
      FakeSocket.latest.send(event, 11 + k);
    });
    return live.station.value!;
  };
  const twice = (position: string) => [0, 1].map(() => ({ position, x_mm: 0, y_mm: 400, done: false }));

  it("add a reading and tick off one visit of its position", () => {
    const { run: now } = events({ type: "reading", data: reading() });
    expect(now?.readings.map((one) => one.reading)).toEqual([1]);
    expect(now?.stops.map(({ done }) => done)).toEqual([true, false]);
  });

  it("tick off the next visit for the next reading there", () => {
    const { run: now } = events(
      { type: "reading", data: reading() },
      { type: "reading", data: reading({ reading: 2 }) },
    );
    expect(now?.stops.map(({ done }) => done)).toEqual([true, true]);
  });

  it("change nothing when the reading is known already", () => {
    const { run: now } = events({ type: "reading", data: reading() }, { type: "reading", data: reading() });
    expect(now?.readings).toHaveLength(1);
    expect(now?.stops.map(({ done }) => done)).toEqual([true, false]);
  });

  it("give readings their residuals", () => {
    const residual = { reading: 2, residual_mm: 0.003, limit_mm: 0.005 };
    const { run: now } = events(
      { type: "reading", data: reading() },
      { type: "reading", data: reading({ reading: 2 }) },
      { type: "residuals", data: [residual] },
    );
    expect(now?.readings.map(({ residual_mm }) => residual_mm)).toEqual([null, 0.003]);
    expect(now?.readings[1]).toMatchObject({ limit_mm: 0.005, scale_mm: 100 });
  });

  it("keep readings and stops over a step of the same run, not into the next one", () => {
    const { stops: _, readings: __, ...step } = run({ step: 3 });
    const { run: same } = events({ type: "reading", data: reading() }, { type: "run", data: step });
    expect(same).toMatchObject({ step: 3, readings: [{ reading: 1 }] });
    FakeSocket.latest.send({ type: "run", data: { ...step, id: 3 } }, 13);
    expect(live.station.value?.run).toMatchObject({ id: 3, readings: [], stops: [] });
  });

  it("begin a pass with its own stops", () => {
    const { run: now } = events({ type: "walk", data: { number: 2, title: "Pass 2", stops: twice("B") } });
    expect(now?.walk).toEqual({ number: 2, title: "Pass 2" });
    expect(now?.stops.map(({ position }) => position)).toEqual(["B", "B"]);
  });

  it("change one device, the interlocks and the machine", () => {
    const device = {
      name: "scale",
      kind: "scale" as const,
      address: "a",
      state: "lost" as const,
      text: "unplugged",
    };
    const interlock = lock({ detail: "the door is open" });
    const machine = { theta1_deg: 1, theta2_deg: 2, x_mm: 3, y_mm: 4, scale_mm: 5, age_s: 0.5 };
    const now = events(
      { type: "device", data: device },
      { type: "interlock", data: [interlock] },
      { type: "machine", data: machine },
    );
    expect(now.devices).toEqual([device]);
    expect(now.interlocks).toEqual([interlock]);
    vi.advanceTimersByTime(1000);
    expect(live.machineAgeS.value).toBeCloseTo(1.5);
  });

  it("end the run, and keep its readings", () => {
    const now = events({ type: "reading", data: reading() }, { type: "ended", data: summary({ id: 2 }) });
    expect(now.run).toBeNull();
    expect(now.last?.id).toBe(2);
    expect(live.shownRun.value?.readings).toHaveLength(1);
  });
});

it("counts the time left down, and not below zero", () => {
  FakeSocket.latest.snapshot({ run: run({ remaining_s: 2 }) });
  FakeSocket.latest.beat(10);
  vi.advanceTimersByTime(500);
  expect(live.remainingS.value).toBeCloseTo(1.5);
  vi.advanceTimersByTime(2000);
  expect(live.remainingS.value).toBe(0);
});

describe("a gap in the numbers", () => {
  it("leads to a new connection and its snapshot", () => {
    const first = FakeSocket.latest;
    first.snapshot();
    first.send({ type: "machine", data: null }, 12);
    expect(FakeSocket.all).toHaveLength(2);
    expect(first.closed).toBe(true);
    FakeSocket.latest.snapshot({ last: summary({ id: 9 }) }, 40);
    expect(live.station.value?.last?.id).toBe(9);
  });

  it("is also found by a beat", () => {
    FakeSocket.latest.snapshot();
    FakeSocket.latest.beat(10);
    expect(FakeSocket.all).toHaveLength(1);
    FakeSocket.latest.beat(11);
    expect(FakeSocket.all).toHaveLength(2);
  });

  it("does not let the old connection change anything", () => {
    const old = FakeSocket.latest;
    old.snapshot();
    old.beat(12);
    old.snapshot({ last: summary({ id: 5 }) });
    expect(live.station.value?.last).toBeNull();
  });
});

describe("a lost beat", () => {
  it("makes the page offline after three seconds, and a message ends that", () => {
    FakeSocket.latest.snapshot();
    vi.advanceTimersByTime(3000);
    expect(live.offline.value).toBe(false);
    vi.advanceTimersByTime(250);
    expect(live.offline.value).toBe(true);
    expect(live.connected.value).toBe(false);
    FakeSocket.latest.beat(10);
    expect(live.offline.value).toBe(false);
  });

  it("leads to a new connection", () => {
    FakeSocket.latest.snapshot();
    vi.advanceTimersByTime(4000);
    expect(FakeSocket.all).toHaveLength(1);
    vi.advanceTimersByTime(250);
    expect(FakeSocket.all).toHaveLength(2);
  });

  it("is not missed while beats arrive", () => {
    FakeSocket.latest.snapshot();
    for (let second = 0; second < 10; second += 1) {
      vi.advanceTimersByTime(1000);
      FakeSocket.latest.beat(10);
    }
    expect(live.offline.value).toBe(false);
    expect(FakeSocket.all).toHaveLength(1);
  });
});

it("connects again a second after the connection was closed", () => {
  FakeSocket.latest.snapshot();
  FakeSocket.latest.close();
  vi.advanceTimersByTime(999);
  expect(FakeSocket.all).toHaveLength(1);
  vi.advanceTimersByTime(1);
  expect(FakeSocket.all).toHaveLength(2);
});

describe("another build of the service", () => {
  it("reloads the page between runs", () => {
    FakeSocket.latest.snapshot();
    vi.advanceTimersByTime(250);
    expect(reload).not.toHaveBeenCalled();
    FakeSocket.latest.beat(10, "b2");
    vi.advanceTimersByTime(250);
    expect(reload).toHaveBeenCalled();
  });

  it("waits for the end of a run", () => {
    FakeSocket.latest.snapshot({ run: run() });
    FakeSocket.latest.beat(10, "b2");
    vi.advanceTimersByTime(250);
    expect(reload).not.toHaveBeenCalled();
    FakeSocket.latest.send({ type: "ended", data: summary({ id: 2 }) }, 11, "b2");
    vi.advanceTimersByTime(250);
    expect(reload).toHaveBeenCalled();
  });
});
