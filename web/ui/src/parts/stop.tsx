/** One step to stop.  Always there, always enabled; it reports when the stop did not reach the station. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { Refused, stop } from "../api";
import { timeOfDay } from "../format";
import { clock, offline, station } from "../live";
import { t } from "../messages";

const report = signal<{ text: string; failed: boolean } | null>(null);

async function press(): Promise<void> {
  const at = timeOfDay(clock.value);
  report.value = offline.value
    ? { text: t.stop.mayNotArrive(at), failed: true }
    : { text: t.stop.stopping(at), failed: false };
  try {
    const { axes, confirmed } = await stop();
    const troubles = Object.entries(axes).flatMap(([axis, trouble]) =>
      trouble ? [`${axis}: ${trouble}`] : [],
    );
    report.value = confirmed
      ? { text: t.stop.stopped(at), failed: false }
      : { text: t.stop.failed(at, troubles.join("; ")), failed: true };
  } catch (error) {
    const cause = error instanceof Refused ? error.message : String(error);
    report.value = { text: t.stop.failed(at, cause), failed: true };
  }
}

export function StopButton() {
  return (
    <button class="stop" type="button" onClick={() => void press()}>
      <span aria-hidden="true" class="square" />
      <span>
        {t.stop.button}
        <small>{t.stop.notEmergency}</small>
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
