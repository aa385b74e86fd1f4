import { connected, station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { deviceName, interlockLimits, interlockName } from "../../names";
import type { DeviceState } from "../../types";

const ALARMS: Record<DeviceState, { shape: string; alarm: string }> = {
  ok: { shape: "", alarm: "" },
  unknown: { shape: "", alarm: "" },
  lost: { shape: "▲ ", alarm: "alarm act" },
  fault: { shape: "▲ ", alarm: "alarm act" },
};

/** Devices and interlocks, each in words. */
export function Devices() {
  const now = station.value;
  const online = connected.value;
  return (
    <section class="devices">
      <h2>{t.station.devices}</h2>
      <ul>
        {now?.devices.map(({ name, state, text }) => (
          <li key={name}>
            <span>{deviceName(name)}</span>
            <strong class={ALARMS[online ? state : "unknown"].alarm}>
              {ALARMS[online ? state : "unknown"].shape}
              {online ? t.devices[state].name : t.station.notKnown}
            </strong>
            {online && state !== "ok" && <small>{said(text) || t.devices[state].text}</small>}
          </li>
        ))}
      </ul>
      <h2>{t.station.interlocks}</h2>
      <ul>
        {now?.interlocks.map((interlock) => (
          <li key={interlock.id}>
            <span>
              {interlockName(interlock)} <small>{interlockLimits(interlock)}</small>
            </span>
            <strong class={interlock.ok || !online ? "" : "alarm warn"}>
              {!online
                ? t.station.notKnown
                : interlock.ok
                  ? t.station.interlockOk
                  : t.station.interlockNotMet}
            </strong>
            {online && !interlock.ok && interlock.detail && <small>{said(interlock.detail)}</small>}
            {online && interlock.ok && interlock.shows && <small>{interlock.shows}</small>}
            {online && interlock.last_trip && (
              <small>
                {t.station.lastTrip(
                  interlock.last_trip.run,
                  interlock.last_trip.stop_frame_ms,
                  interlock.last_trip.standstill_ms,
                )}
              </small>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}
