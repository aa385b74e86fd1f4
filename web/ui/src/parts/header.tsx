import { timeOfDay, zone } from "../format";
import { clock, connected, offline, station } from "../live";
import { t } from "../messages";
import { deviceName } from "../names";
import { path } from "../router";
import { session } from "../session";
import { LanguageChoice } from "./language-choice";
import { Link } from "./link";
import { ScanNotice } from "./scan-notice";
import { StopButton, StopReport } from "./stop";
import { Who } from "./who";

const VIEWS = [
  { to: "/", text: t.header.station, views: ["/"] },
  { to: "/result", text: t.header.result, views: ["/result", "/diagnosis"] },
  { to: "/history", text: t.header.history, views: ["/history"] },
  { to: "/maintenance", text: t.header.maintenance, views: ["/maintenance"] },
];

export function Header() {
  return (
    <header>
      <div class="bar">
        <nav aria-label={t.header.views}>
          {VIEWS.map(({ to, text, views }) => (
            <Link key={to} to={to} current={views.includes(`/${path.value.split("/")[1]}`)}>
              {text}
            </Link>
          ))}
        </nav>
        <StationStatus />
        <StopButton />
      </div>
      <div class="under">
        <Who />
        <LanguageChoice />
      </div>
      <StopReport />
      <ScanNotice />
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
        <span>{session.value === null ? "" : beside()}</span>
      </div>
      <div class="where">
        <span class="name">{info?.emulated ? t.header.emulated(info.name) : (info?.name ?? t.title)}</span>
        <time>
          {timeOfDay(clock.value)} <small>{zone(clock.value)}</small>
        </time>
      </div>
    </div>
  );
}

function beside(): string {
  if (offline.value) return t.header.stale;
  return connected.value ? t.header.connected : t.header.connecting;
}

function status(): { text: string; alarm?: "act" | "warn" } {
  const now = station.value;
  // a user who is not signed in gets no values, although the station is running
  if (session.value === null) return { text: t.header.signInFirst };
  if (offline.value) return { text: t.header.offline, alarm: "act" };
  if (!now) return { text: t.header.notConnected };
  const lost = now.devices.find((device) => device.state === "lost" || device.state === "fault");
  if (lost) return { text: t.header.device(deviceName(lost.name), t.devices[lost.state].name), alarm: "act" };
  if (now.run) return { text: t.states[now.run.state].name.toUpperCase() };
  if (now.interlocks.some((interlock) => !interlock.ok)) return { text: t.header.notReady, alarm: "warn" };
  return { text: t.header.ready };
}
