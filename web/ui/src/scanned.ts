/** The effect of each scan, in any view. */
import { effect, signal, untracked } from "@preact/signals";
import * as api from "./api";
import { confirm, disarm } from "./armed";
import { connected, station } from "./live";
import { t } from "./messages";
import { operator } from "./operator";
import { navigate, path } from "./router";
import type { Scan } from "./scanner";
import { badge, session } from "./session";
import type { RefusedScan, ScanCodes } from "./types";
import { scans, takeSerial } from "./views/station/start";

const RETRY_MS = 2000;
/** Maximum wait of a scan until the page knows its effect. */
const EARLY_MS = 3000;
const LONGEST = 64;
/** Maximum number of refused scans kept for a station that does not respond. */
const MOST_UNSENT = 50;

/** The result of the last scan, in words. */
export const notice = signal<{ text: string; refused: boolean } | null>(null);
const codes = signal<ScanCodes | null>(null);
const early = signal<Scan | null>(null);
let unsent: RefusedScan[] = [];

/** The patterns come from the station, with any delay; refused scans are sent to it. */
export function watchScans(): void {
  const load = () =>
    api.scanCodes().then(
      (known) => {
        codes.value = known;
      },
      () => {
        setTimeout(() => void load(), RETRY_MS);
      },
    );
  void load();
  effect(() => {
    if (connected.value) void send();
  });
  effect(() => {
    const scan = early.value;
    const known = codes.value;
    if (!scan || !known || session.value === undefined) return;
    early.value = null;
    untracked(() => take(scan, known));
  });
}

export function scanned(scan: Scan): void {
  const known = codes.peek();
  notice.value = null;
  if (known && scan.readable && scan.text === known.confirm && confirm()) return;
  disarm();
  if (known && session.peek() !== undefined) take(scan, known);
  else wait(scan);
}

/** The last scan before the station has sent the patterns of its codes and the signed-in user. */
function wait(scan: Scan): void {
  early.value = scan;
  setTimeout(() => {
    if (early.peek() !== scan) return;
    early.value = null;
    notice.value = { text: t.scan.noCodes, refused: true };
  }, EARLY_MS);
}

/**
 * Any scan except a confirmation: a delayed scan confirms nothing, because it was made before the question.
 */
function take({ text, readable, secret }: Scan, known: ScanCodes): void {
  disarm();
  const field = fieldForBadges();
  const badgeOf = readable ? matching(known.badge, text) : null;
  if (!readable) refuse(secret ? "" : text, "unreadable", t.scan.unreadable);
  else if (text === known.confirm) refuse(text, "nothing_to_confirm", t.scan.nothingToConfirm);
  else if (badgeOf && field) fill(field, text);
  else if (badgeOf) signOn(text, badgeOf[1] ?? text);
  else if (!secret && matching(known.serial, text)) toStation(text);
  else refuse(secret ? "" : text, "unknown", secret ? t.scan.unknown : t.scan.notSerial(shortened(text)));
}

/** The pattern applies to the whole text; one that this browser does not support matches nothing. */
function matching(pattern: string, text: string): RegExpExecArray | null {
  try {
    return new RegExp(`^(?:${pattern})$`).exec(text);
  } catch {
    return null;
  }
}

const fieldForBadges = () => document.querySelector<HTMLInputElement>("input[data-takes-badge]:focus");

function fill(field: HTMLInputElement, text: string): void {
  field.value = text;
  field.dispatchEvent(new Event("input", { bubbles: true }));
}

const shortened = (text: string) => (text.length > LONGEST ? `${text.slice(0, LONGEST - 1)}…` : text);

function signOn(text: string, name: string): void {
  if (!station.peek()?.station.open) badge.value = text;
  else {
    operator.value = shortened(name);
    scans.value += 1;
    notice.value = { text: t.scan.signedOn(operator.value), refused: false };
  }
}

function toStation(text: string): void {
  if (!session.peek()) {
    notice.value = { text: t.scan.signInFirst, refused: true };
    return;
  }
  if (path.peek() !== "/") navigate("/");
  takeSerial(text);
}

function refuse(text: string, because: RefusedScan["because"], why: string): void {
  notice.value = { text: why, refused: true };
  // biome-ignore lint/suspicious/noControlCharactersInRegex: the service takes none
  const kept = text.replace(/[\x00-\x1f\x7f]/g, "").slice(0, LONGEST);
  unsent = [...unsent, { text: kept, because }].slice(-MOST_UNSENT);
  void send();
}

/** One after the other, in order. A scan that the station refuses is not sent again. */
async function send(): Promise<void> {
  const waiting = unsent;
  unsent = [];
  for (const [n, scan] of waiting.entries()) {
    try {
      await api.refusedScan(scan);
    } catch (error) {
      if (error instanceof api.Refused && error.status !== null) continue;
      unsent = [...waiting.slice(n), ...unsent].slice(-MOST_UNSENT);
      return;
    }
  }
}
