import { clock, connected, offline, station } from "../live";
import { path } from "../router";
import { timeOfDay } from "../format";
import { Link } from "./link";
import { StopButton, StopReport } from "./stop";

const VIEWS = [
  { to: "/", text: "Station", views: ["/"] },
  { to: "/result", text: "Result", views: ["/result", "/diagnosis"] },
  { to: "/history", text: "History", views: ["/history"] },
];

export function Header() {
  return (
    <header>
      <div class="bar">
        <nav aria-label="Views">
          {VIEWS.map(({ to, text, views }) => (
            <Link to={to} current={views.includes(`/${path.value.split("/")[1]}`)}>
              {text}
            </Link>
          ))}
        </nav>
        <StationStatus />
        <StopButton />
      </div>
      <StopReport />
    </header>
  );
}

function StationStatus() {
  const { text, alarm } = status();
  const info = station.value?.station;
  return (
    <div class="status">
      <div class="state" role="status">
        <strong class={alarm ? `alarm ${alarm}` : ""}>{text}</strong>
        <span>{offline.value ? "values may be old" : connected.value ? "connected" : "connecting …"}</span>
      </div>
      <div class="where">
        <span class="name">
          {info?.name ?? "Calibration station"}
          {info?.emulated && " (emulated)"}
        </span>
        <time>{timeOfDay(clock.value)}</time>
      </div>
    </div>
  );
}

function status(): { text: string; alarm?: "act" | "warn" } {
  const now = station.value;
  if (offline.value) return { text: "▲ OFFLINE", alarm: "act" };
  if (!now) return { text: "CONNECTING" };
  const lost = now.devices.find((device) => device.state === "lost" || device.state === "fault");
  if (lost) return { text: `▲ ${lost.name}: ${lost.state}`, alarm: "act" };
  if (now.run) return { text: now.run.state === "queued" ? "WAITING" : "RUNNING" };
  if (now.interlocks.some((interlock) => !interlock.ok)) return { text: "◆ NOT READY", alarm: "warn" };
  return { text: "READY" };
}
