/** The actions and their authors, page by page. */
import { dateTime } from "../../format";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import { navigate, query } from "../../router";
import type { AuditEntry, Role, User } from "../../types";
import { Pending } from "./action";
import { Needs } from "./allowed";
import { audit, users } from "./calls";
import { Table } from "./table";

export function AuditPart() {
  return (
    <section class="panel part" aria-labelledby="audit-title">
      <h2 id="audit-title">{t.maintenance.audit}</h2>
      <Needs permission="administer">
        <Entries />
      </Needs>
    </section>
  );
}

function Entries() {
  const m = t.maintenance;
  const cursor = query.value.get("cursor") ?? "";
  const wanted = query.value.get("contains") ?? "";
  const contained: Record<string, string> = wanted.trim() ? { contains: wanted.trim() } : {};
  const asked = new URLSearchParams({ limit: "200", ...(cursor && { cursor }), ...contained });
  const { value: page, trouble } = useLoaded(String(asked), () => audit(asked)).value;
  const known = useLoaded("", users).value.value?.items ?? [];
  if (!page) return <Pending trouble={trouble} />;
  return (
    <>
      <div class="fields">
        <p class="field">
          <label for="audit-filter">{m.auditFilter}</label>
          <input
            id="audit-filter"
            value={wanted}
            spellcheck={false}
            onInput={(event) => show("", event.currentTarget.value, true)}
          />
        </p>
        <a class="button" href="/api/v1/audit.csv">
          {m.auditCsv}
        </a>
      </div>
      <p class="note" role="status">
        {m.auditOnPage(page.items.length)}
      </p>
      <Table label={m.audit} head={[m.number, m.at, m.who, m.role, m.action, m.subject, m.change]}>
        {page.items.map((entry) => (
          <tr key={entry.n}>
            <td class="text">{entry.n}</td>
            <td class="text">{dateTime(entry.at)}</td>
            <td class="text">{entry.who ?? m.erased}</td>
            <td class="text">{entry.role ? m.roles[entry.role] : m.via[entry.via]}</td>
            <td class="text">
              {m.actions[entry.action as keyof typeof m.actions]} <small>{entry.action}</small>
            </td>
            <td class="text wrapped">{subject(entry.subject, known)}</td>
            <td class="text wrapped">{change(entry)}</td>
          </tr>
        ))}
      </Table>
      <p class="actions">
        <button type="button" disabled={!cursor} onClick={() => show("", wanted)}>
          {m.newest}
        </button>
        <button
          type="button"
          disabled={page.next === null}
          onClick={() => page.next !== null && show(String(page.next), wanted)}
        >
          {m.older}
        </button>
      </p>
    </>
  );
}

const show = (cursor: string, contained: string, replace = false) =>
  navigate(
    `/maintenance?${new URLSearchParams({ part: "audit", ...(cursor && { cursor }), ...(contained && { contains: contained }) })}`,
    { replace },
  );

export function change({ before, after }: AuditEntry): string {
  if (before == null) return after == null ? "" : told(after);
  return t.maintenance.from(told(before), after == null ? "–" : told(after));
}

/** `user 4 (Ada)`: entries name users by number, so that a name can be erased. */
function subject(text: string, known: User[]): string {
  const user = known.find((one) => text === `user ${one.id}`);
  return user ? `${text} (${user.name})` : text;
}

/** `{"value": "20"}` as `value 20`; parts without a value are left out. */
function told(value: unknown, key = ""): string {
  const m = t.maintenance;
  if (typeof value === "boolean") return value ? m.yes : m.no;
  if (key === "role") return m.roles[value as Role];
  if (key === "until") return dateTime(String(value));
  if (typeof value !== "object" || value === null) return String(value);
  return Object.entries(value)
    .map(([name, part]): [string, string] => [name, part === null ? "" : told(part, name)])
    .filter(([, part]) => part !== "")
    .map(([name, part]) => `${m.auditFields[name] ?? name.replaceAll("_", " ")} ${part}`)
    .join(", ");
}
