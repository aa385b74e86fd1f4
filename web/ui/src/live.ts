/** The live feed: one snapshot, then numbered events; after a gap or a silence a new snapshot. */
import { computed, signal } from "@preact/signals";
import type { LiveEvent, LiveMessage, Run, RunReading, Station } from "./types";

const BEATS_MISSED_MS = 3000;
const RETRY_MS = 1000;
const TICK_MS = 250;

/** The station as last reported; null until the first snapshot. */
export const station = signal<Station | null>(null);
/** The active run, otherwise the last one, with its map and readings. */
export const shownRun = computed(() => station.value?.run ?? station.value?.finished ?? null);
/** Milliseconds of the page's own clock; every displayed age uses it. */
export const now = signal(performance.now());
const heardAt = signal(performance.now());
const machineAt = signal(0);
const runAt = signal(0);
/** The station's clock less the page's; null until the first message of the station. */
const clockOffset = signal<number | null>(null);
/** Number of live feeds that have opened or ended. */
export const links = signal(0);

export const offline = computed(() => now.value - heardAt.value > BEATS_MISSED_MS);
export const connected = computed(() => station.value !== null && !offline.value);
export const clock = computed(() => new Date(performance.timeOrigin + now.value + (clockOffset.value ?? 0)));
export const machineAgeS = computed(
  () => (station.value?.machine?.age_s ?? 0) + Math.max(0, now.value - machineAt.value) / 1000,
);
export const remainingS = computed(() => {
  const remaining = station.value?.run?.remaining_s;
  return remaining == null ? null : Math.max(0, remaining - (now.value - runAt.value) / 1000);
});

/** The time by the station's clock, ms since 1970. */
export const stationTime = () =>
  clockOffset.peek() === null ? null : performance.timeOrigin + performance.now() + clockOffset.peek()!;

let socket: WebSocket | null = null;
let openedAt = 0;
let number = 0;
let build: string | null = null;
let newBuild = false;

export function connect(): void {
  open();
  setInterval(() => {
    now.value = performance.now();
    // a frozen server closes no connection: only the silence reveals it
    const quietSince = Math.max(heardAt.value, openedAt);
    if (now.value - quietSince > BEATS_MISSED_MS + RETRY_MS) reopen();
    if (newBuild && !station.value?.run) location.reload();
  }, TICK_MS);
}

function open(): void {
  openedAt = performance.now();
  const mine = new WebSocket(
    `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/v1/live`,
  );
  socket = mine;
  links.value += 1;
  mine.onmessage = (event) => {
    if (socket === mine) receive(JSON.parse(event.data as string) as LiveMessage);
  };
  mine.onclose = () => {
    if (socket === mine) links.value += 1;
    setTimeout(() => {
      if (socket === mine) open();
    }, RETRY_MS);
  };
}

function reopen(): void {
  socket?.close();
  open();
}

function receive(message: LiveMessage): void {
  const time = performance.now();
  heardAt.value = now.value = time;
  clockOffset.value = Date.parse(message.at) - performance.timeOrigin - time;
  build ??= message.build;
  newBuild = build !== message.build;
  const expected = message.type === "beat" ? number : number + 1;
  if (message.type !== "snapshot" && message.number !== expected) {
    reopen();
    return;
  }
  number = message.number;
  if (message.type === "snapshot" || message.type === "machine") machineAt.value = time;
  if (message.type === "snapshot" || message.type === "run") runAt.value = time;
  if (message.type === "snapshot") station.value = message.data;
  else if (station.value) station.value = apply(station.value, message);
}

/** Events state facts by id: one that the snapshot already contains changes nothing. */
function apply(before: Station, event: LiveEvent): Station {
  const run = before.run;
  switch (event.type) {
    case "run": {
      const same = run?.id === event.data.id ? run : null;
      return { ...before, run: { ...event.data, stops: same?.stops ?? [], readings: same?.readings ?? [] } };
    }
    case "walk": {
      const { number, title, stops } = event.data;
      return run ? { ...before, run: { ...run, walk: { number, title }, stops } } : before;
    }
    case "reading":
      return run ? { ...before, run: withReading(run, event.data) } : before;
    case "residuals": {
      const known = new Map(event.data.map((residual) => [residual.reading, residual]));
      const readings = run?.readings.map((reading) => ({ ...reading, ...known.get(reading.reading) }));
      return run && readings ? { ...before, run: { ...run, readings } } : before;
    }
    case "machine":
      return { ...before, machine: event.data };
    case "device":
      return { ...before, devices: before.devices.map((d) => (d.name === event.data.name ? event.data : d)) };
    case "interlock":
      return { ...before, interlocks: event.data };
    case "retract":
      return { ...before, retract: event.data };
    case "ended":
      return { ...before, run: null, last: event.data, finished: run ?? before.finished ?? null };
    default:
      return before;
  }
}

function withReading(run: Run, reading: RunReading): Run {
  if (run.readings.some((known) => known.reading === reading.reading)) return run;
  const visited = run.stops.findIndex((stop) => stop.position === reading.position && !stop.done);
  const stops = run.stops.map((stop, i) => (i === visited ? { ...stop, done: true } : stop));
  return { ...run, stops, readings: [...run.readings, reading] };
}
