/** Whether a user is active at the page: its automatic requests must not extend a session. */

/** Time after a touch within which requests count as caused by it. */
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

/** Headers of a request: none, or the mark of an automatic one. */
export function attendance(): Record<string, string> {
  return performance.now() - touchedAt > LASTS_MS ? { "X-Unattended": "1" } : {};
}
