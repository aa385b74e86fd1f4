/** The wire traffic of a run: request, reply, and elapsed time. */
import { useSignal } from "@preact/signals";
import { fixed } from "../../format";
import { station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { useLoaded } from "../../parts/load";
import { navigate, query } from "../../router";
import type { WireExchange } from "../../types";
import { Pending } from "./action";
import { wire } from "./calls";
import { TextField } from "./fields";
import { Table } from "./table";

const PAGE = 100;

export function WirePart() {
  const wanted = query.value.get("run") ?? String(station.value?.last?.id ?? "");
  const typed = useSignal(wanted);
  const cursor = Number(query.value.get("cursor") ?? 0) || 0;
  const run = Number(wanted);
  return (
    <section class="panel part" aria-labelledby="wire-title">
      <h2 id="wire-title">{t.maintenance.wire}</h2>
      <form
        class="fields"
        onSubmit={(event) => {
          event.preventDefault();
          show(typed.value.trim(), 0);
        }}
      >
        <TextField id="wire-run" label={t.maintenance.wireRun} value={typed} numeric />
        <button type="submit">{t.maintenance.wireShow}</button>
      </form>
      {Number.isInteger(run) && run > 0 ? (
        <Exchanges run={run} cursor={cursor} />
      ) : (
        <p class="empty">{t.maintenance.wireNone}</p>
      )}
    </section>
  );
}

const show = (run: string, cursor: number) =>
  navigate(`/maintenance?${new URLSearchParams({ part: "wire", run, cursor: String(cursor) })}`);

function Exchanges({ run, cursor }: { run: number; cursor: number }) {
  const { value: page, trouble } = useLoaded(`${run} ${cursor}`, () => wire(run, cursor)).value;
  if (!page) return <Pending trouble={trouble} />;
  const next = page.next;
  return (
    <>
      <Table label={t.maintenance.wire} head={[t.maintenance.time, t.maintenance.said, t.maintenance.took]}>
        {page.items.map((exchange, index) => (
          <tr key={index}>
            <td class="text">{fixed(exchange.at_s, 4)}</td>
            <td class="text wrapped">{inWords(exchange)}</td>
            <td class="text">{fixed(exchange.took_ms, 1)}</td>
          </tr>
        ))}
      </Table>
      <p class="actions">
        <button
          type="button"
          disabled={cursor === 0}
          onClick={() => show(String(run), Math.max(0, cursor - PAGE))}
        >
          {t.maintenance.earlier}
        </button>
        <button
          type="button"
          disabled={next === null}
          onClick={() => next !== null && show(String(run), next)}
        >
          {t.maintenance.later}
        </button>
      </p>
    </>
  );
}

/** "Asked drive 2 for its position: 12.345°". */
export function inWords(exchange: WireExchange): string {
  const m = t.maintenance;
  const device = m.wireDevices[exchange.device];
  const answer = said(exchange.answer);
  if (exchange.action === "broken") return m.wireBroken(answer);
  if (exchange.action === "refused") return m.wireRefused(answer);
  const beside = exchange.beside ? ` (${m.wireBeside})` : "";
  if (exchange.angle_deg != null) return m.wirePosition(device, fixed(exchange.angle_deg, 3)) + beside;
  const say = { read: m.wireRead, write: m.wireWrite, other: m.wireOther }[exchange.action];
  const silent = exchange.action === "other" ? "–" : m.wireSilent;
  return `${say(device, said(exchange.subject))} → ${exchange.took_ms === null ? silent : answer}${beside}`;
}
