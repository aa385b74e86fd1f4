/** One step to stop.  Always there, always pressable; it says when the stop did not arrive. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { Refused, stop } from "../api";
import { timeOfDay } from "../format";
import { clock, offline, station } from "../live";

const report = signal<{ text: string; failed: boolean } | null>(null);

async function press(): Promise<void> {
  const at = timeOfDay(clock.value);
  report.value = offline.value
    ? { text: `Offline: the stop of ${at} may not arrive. Press the emergency stop.`, failed: true }
    : { text: `Stopping, pressed at ${at} …`, failed: false };
  try {
    await stop();
    report.value = { text: `Stopped at ${at}: both drives confirmed.`, failed: false };
  } catch (error) {
    const cause = error instanceof Refused ? error.message : String(error);
    report.value = { text: `STOP FAILED at ${at}: ${cause} Press the emergency stop.`, failed: true };
  }
}

export function StopButton() {
  return (
    <button class="stop" type="button" onClick={() => void press()}>
      <span aria-hidden="true" class="square" />
      <span>
        STOP
        <small>not the emergency stop</small>
      </span>
    </button>
  );
}

/** Stays until the next stop or the next start. */
export function StopReport() {
  const run = station.value?.run?.id;
  useEffect(() => {
    if (run !== undefined) report.value = null;
  }, [run]);
  return (
    <p class={`report ${report.value?.failed ? "alarm act" : ""}`} role="alert" hidden={!report.value}>
      {report.value?.failed && "▲ "}
      {report.value?.text}
    </p>
  );
}
