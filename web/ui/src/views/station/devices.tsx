import type { Device } from "../../api";
import { station } from "../../live";

const WORDS: Record<Device["state"], { word: string; alarm: string }> = {
  ok: { word: "ok", alarm: "" },
  unknown: { word: "not asked yet", alarm: "" },
  lost: { word: "▲ lost", alarm: "alarm act" },
  fault: { word: "▲ fault", alarm: "alarm act" },
};

/** Devices and interlocks, each in words. */
export function Devices() {
  const now = station.value;
  return (
    <section class="devices">
      <h2>Devices</h2>
      <ul>
        {now?.devices.map((device) => (
          <li key={device.name}>
            <span>{device.name}</span>
            <strong class={WORDS[device.state].alarm}>{WORDS[device.state].word}</strong>
            {device.state !== "ok" && device.text && <small>{device.text}</small>}
          </li>
        ))}
      </ul>
      <h2>Interlocks</h2>
      <ul>
        {now?.interlocks.map((interlock) => (
          <li key={interlock.id}>
            <span>{interlock.text}</span>
            <strong class={interlock.ok ? "" : "alarm warn"}>{interlock.ok ? "ok" : "◆ not met"}</strong>
            {!interlock.ok && interlock.detail && <small>{interlock.detail}</small>}
          </li>
        ))}
      </ul>
    </section>
  );
}
