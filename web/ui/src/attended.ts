/** Whether somebody is at the page: what it asks by itself must keep nobody signed in. */

/** What a touch leads to may be asked so long after it. */
const LASTS_MS = 60_000;

let touchedAt = performance.now();

for (const sign of ["pointerdown", "keydown", "wheel"]) {
  addEventListener(
    sign,
    () => {
      touchedAt = performance.now();
    },
    { capture: true, passive: true },
  );
}

/** Headers of a request: none, or that nobody asked for it. */
export function attendance(): Record<string, string> {
  return performance.now() - touchedAt > LASTS_MS ? { "X-Unattended": "1" } : {};
}
