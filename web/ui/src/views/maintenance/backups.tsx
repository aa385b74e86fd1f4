/** Backups, and whether one could replace the history. */
import { useSignal } from "@preact/signals";
import { dateTime, fixed } from "../../format";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import type { BackupDrill } from "../../types";
import { ActionButton, Pending } from "./action";
import { Needs } from "./allowed";
import { backUp, backups, drill } from "./calls";
import { Table } from "./table";

const BYTES_PER_MB = 1e6;

export function BackupsPart() {
  const m = t.maintenance;
  const made = useSignal(0);
  const drilled = useSignal<BackupDrill | null>(null);
  const { value, trouble } = useLoaded(String(made.value), backups).value;
  return (
    <>
      <section class="panel part" aria-labelledby="backups-title">
        <h2 id="backups-title">{m.backups}</h2>
        <Needs permission="maintain">
          <ActionButton
            act={async () => {
              await backUp();
              made.value += 1;
            }}
          >
            {m.makeBackup}
          </ActionButton>
        </Needs>
        {!value && <Pending trouble={trouble} />}
        {value?.items.length === 0 && <p class="empty">{m.noBackups}</p>}
        {value && value.items.length > 0 && (
          <Table label={m.backups} head={[m.made, m.size, m.file]}>
            {value.items.map((backup) => (
              <tr key={backup.file}>
                <td class="text">{dateTime(backup.made_at)}</td>
                <td class="text">{fixed(backup.bytes / BYTES_PER_MB, 2)}</td>
                <td class="text wrapped">{backup.file}</td>
              </tr>
            ))}
          </Table>
        )}
      </section>
      <section class="panel part" aria-labelledby="drill-title">
        <h2 id="drill-title">{m.drill}</h2>
        <p>{m.drillNote}</p>
        <Needs permission="maintain">
          <ActionButton
            act={async () => {
              drilled.value = await drill();
              made.value += 1;
            }}
          >
            {m.drill}
          </ActionButton>
          <div role="status">{drilled.value && <Drilled found={drilled.value} />}</div>
        </Needs>
      </section>
    </>
  );
}

function Drilled({ found }: { found: BackupDrill }) {
  const m = t.maintenance;
  return (
    <>
      <p class={found.passed ? "main" : "alarm act"}>
        {found.passed ? m.drillPassed(fixed(found.seconds, 1)) : m.drillFailed(found.trouble)}
      </p>
      {found.passed && <p>{m.drillChain(found.chained_runs, found.audit_entries)}</p>}
      <Table label={m.drill} head={[m.table, m.rowsBefore, m.rowsBackup, m.rowsAfter]}>
        {found.tables.map((table) => (
          <tr key={table.table}>
            <th scope="row" class="text">
              {m.tables[table.table] ?? table.table}
            </th>
            <td class="text">{table.before}</td>
            <td class="text">{table.backup}</td>
            <td class="text">{table.after}</td>
          </tr>
        ))}
      </Table>
      <p class="note wrapped">{m.drillRestore(found.restore)}</p>
    </>
  );
}
