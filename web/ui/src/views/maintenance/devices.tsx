/** Devices and their lines, the examination, the return into the workspace and the reference check. */
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { newKey, start } from "../../api";
import { duration, fixed } from "../../format";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { deviceName } from "../../names";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { OperatorField } from "../../parts/operator-field";
import type { DeviceDetail } from "../../types";
import { Retract } from "../station/retract";
import { Pending } from "./action";
import { may, Needs } from "./allowed";
import { devices } from "./calls";
import { Doctor } from "./doctor";
import { TextField } from "./fields";
import { Table } from "./table";

const LOOK_MS = 2000;

export function DevicesPart() {
  return (
    <>
      <DeviceTable />
      <Doctor />
      <WayBack />
      <Check />
    </>
  );
}

function DeviceTable() {
  const look = useSignal(0);
  useEffect(() => {
    const timer = setInterval(() => {
      if (connected.value) look.value += 1;
    }, LOOK_MS);
    return () => clearInterval(timer);
  }, []);
  const { value, trouble } = useLoaded(String(look.value), devices).value;
  const m = t.maintenance;
  return (
    <section class="panel" aria-labelledby="devices-title">
      <h2 id="devices-title">{m.devices}</h2>
      {value ? (
        <Table
          label={m.devices}
          head={[m.device, m.state, m.identity, m.heard, m.roundTrip, m.errors, m.address]}
        >
          {value.items.map((device) => (
            <DeviceRow key={device.name} device={device} />
          ))}
        </Table>
      ) : (
        <Pending trouble={trouble} />
      )}
      <p class="note">{m.roundTripNote}</p>
    </section>
  );
}

function DeviceRow({ device }: { device: DeviceDetail }) {
  const wrong = device.state === "lost" || device.state === "fault";
  const heard = device.heard_s === null ? t.maintenance.never : t.maintenance.ago(duration(device.heard_s));
  return (
    <tr>
      <th scope="row" class="text">
        {deviceName(device.name)}
      </th>
      <td class="text wrapped">
        <strong class={wrong ? "alarm act" : undefined}>
          {wrong && "▲ "}
          {t.devices[device.state].name}
        </strong>
        {device.text && <small> {said(device.text)}</small>}
      </td>
      <td class="text wrapped">{device.identity || "–"}</td>
      <td class="text">{heard}</td>
      <td class="text">{fixed(device.round_trip_ms, 2)}</td>
      <td class="text">{device.errors}</td>
      <td class="text wrapped">{device.address}</td>
    </tr>
  );
}

function WayBack() {
  const needed = station.value?.retract.needed;
  if (needed && may("operate")) return <Retract />;
  return (
    <section class="panel part" aria-labelledby="way-back-title">
      <h2 id="way-back-title">{t.maintenance.wayBack}</h2>
      {needed ? <Needs permission="operate">{null}</Needs> : <p>{t.maintenance.wayBackNotNeeded}</p>}
    </section>
  );
}

/** The robot measured last, unless another one is named. */
function Check() {
  const serial = useSignal(station.value?.last?.robot_serial ?? "");
  const started = useSignal<number | null>(null);
  const now = station.value;
  if (!now?.station.plans.includes("check")) return null;
  const wanted = serial.value.trim();
  const ready = connected.value && !now.run && wanted !== "" && operator.value.trim() !== "";
  const act = async () => {
    keepOperator();
    const body = {
      robot_serial: wanted,
      plan: "check" as const,
      operator: operator.value.trim(),
      references: [],
    };
    started.value = (await start(body, newKey())).id;
  };
  return (
    <section class="panel part" aria-labelledby="check-title">
      <h2 id="check-title">{t.maintenance.check}</h2>
      <p>{t.maintenance.checkNote}</p>
      <Needs permission="operate">
        <div class="fields">
          <TextField id="check-serial" label={t.maintenance.checkSerial} value={serial} />
          <OperatorField id="check-operator" />
        </div>
        <ConfirmedButton label={t.maintenance.checkStart} disabled={!ready} act={act} about={wanted}>
          <strong>{t.shared.willMove(wanted)}</strong>
          {t.result.wholeWorkspace} {t.shared.clear}
        </ConfirmedButton>
        {started.value !== null && (
          <p role="status">
            <Link to={`/result/${started.value}`} class="button">
              {t.maintenance.checkStarted(started.value)}
            </Link>
          </p>
        )}
      </Needs>
    </section>
  );
}
