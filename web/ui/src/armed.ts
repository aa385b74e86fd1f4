/** The pending confirmation: one at a time, ten seconds at most; any other event withdraws it. */
import { computed, effect, signal } from "@preact/signals";
import { connected, links, now, station } from "./live";
import { path } from "./router";
import { session } from "./session";

const LASTS_MS = 10_000;

interface Armed {
  /** Owner of the question. */
  by: object;
  /** By the page's clock. */
  until: number;
  confirmed: () => void;
}

export const armed = signal<Armed | null>(null);
/** The page's clock ticks at intervals: a confirmation armed since its last tick has its full time. */
export const secondsLeft = computed(() => {
  const leftMs = armed.value ? armed.value.until - now.value : 0;
  return Math.ceil(Math.min(Math.max(leftMs, 0), LASTS_MS) / 1000);
});

export function arm(by: object, confirmed: () => void): void {
  armed.value = { by, until: performance.now() + LASTS_MS, confirmed };
}

/** The pending confirmation, or only that of this owner. */
export function disarm(by?: object): void {
  if (by === undefined || armed.peek()?.by === by) armed.value = null;
}

/** Confirms the pending action, or only that of this owner, once; returns whether there was one. */
export function confirm(by?: object): boolean {
  const waiting = armed.peek();
  if (by !== undefined && waiting?.by !== by) return false;
  armed.value = null;
  if (!waiting || performance.now() >= waiting.until) return false;
  waiting.confirmed();
  return true;
}

/** Withdraw it when its time is over, and after any change of its meaning. */
export function watchArmed(): () => void {
  const escaped = (event: KeyboardEvent) => {
    if (event.key === "Escape") disarm();
  };
  const away = () => disarm();
  document.addEventListener("keydown", escaped, { capture: true });
  document.addEventListener("visibilitychange", away);
  addEventListener("pagehide", away);
  let last = session.peek();
  const run = computed(() => station.value?.run?.id);
  const online = computed(() => connected.value);
  const effects = [
    effect(() => {
      if (armed.value && now.value >= armed.value.until) disarm();
    }),
    effect(() => {
      const before = last;
      last = session.value;
      // the first answer on who is signed in is not a change
      if (before !== undefined && before?.name !== last?.name) disarm();
    }),
    ...[path, run, online, links].map((changed) =>
      effect(() => {
        changed.value;
        disarm();
      }),
    ),
  ];
  return () => {
    document.removeEventListener("keydown", escaped, { capture: true });
    document.removeEventListener("visibilitychange", away);
    removeEventListener("pagehide", away);
    for (const stop of effects) stop();
  };
}
