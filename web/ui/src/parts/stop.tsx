/** One step to stop. Always present, always enabled; it reports if the stop did not reach the station. */
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Refused, stop } from "../api";
import { timeOfDay } from "../format";
import { clock, connected, offline, station } from "../live";
import { t } from "../messages";
import { said } from "../messages/said";
import { deviceName } from "../names";
import { session } from "../session";

const report = signal<{ text: string; failed: boolean; at: string } | null>(null);

async function press(): Promise<void> {
  const at = timeOfDay(clock.value);
  report.value =
    offline.value && session.value !== null
      ? { text: t.stop.mayNotArrive(at), failed: true, at }
      : { text: t.stop.stopping(at), failed: false, at };
  try {
    const { axes, confirmed } = await stop();
    const troubles = Object.entries(axes).flatMap(([axis, trouble]) =>
      trouble ? [`${deviceName(axis)}: ${said(trouble)}`] : [],
    );
    report.value = confirmed
      ? { text: t.stop.stopped(at), failed: false, at }
      : { text: t.stop.failed(at, troubles.join("; ")), failed: true, at };
  } catch (error) {
    const cause = error instanceof Refused ? error.message : String(error);
    report.value = { text: t.stop.failed(at, cause), failed: true, at };
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

/** Shown until the next stop or the next start; a failed one only until the station is reachable again. */
export function StopReport() {
  const run = station.value?.run?.id;
  useEffect(() => {
    if (run !== undefined) report.value = null;
  }, [run]);
  const online = connected.value;
  const wasOnline = useRef(online);
  useEffect(() => {
    const said = report.peek();
    if (online && !wasOnline.current && said?.failed) {
      report.value = { ...said, text: t.stop.wasFailed(said.at), failed: false };
    }
    wasOnline.current = online;
  }, [online]);
  return (
    <p class={`report ${report.value?.failed ? "alarm act" : ""}`} role="alert" hidden={!report.value}>
      {report.value?.failed && "▲ "}
      {report.value?.text}
    </p>
  );
}
