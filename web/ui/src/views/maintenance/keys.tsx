/** Keys of programs; a new one is shown once. */
import { useSignal } from "@preact/signals";
import { dateTime } from "../../format";
import { clock, connected } from "../../live";
import { t } from "../../messages";
import { ConfirmedButton } from "../../parts/confirm";
import { useLoaded } from "../../parts/load";
import type { ApiKey, Role } from "../../types";
import { ActionButton, Pending } from "./action";
import { addKey, keys, revokeKey } from "./calls";
import { ChoiceField, TextField } from "./fields";
import { Table } from "./table";
import { ROLE_OPTIONS } from "./users";

export function Keys() {
  const m = t.maintenance;
  const changed = useSignal(0);
  const { value, trouble } = useLoaded(String(changed.value), keys).value;
  const again = () => {
    changed.value += 1;
  };
  return (
    <section class="panel part" aria-labelledby="keys-title">
      <h2 id="keys-title">{m.keys}</h2>
      {!value && <Pending trouble={trouble} />}
      {value?.items.length === 0 && <p class="empty">{m.noKeys}</p>}
      {value && value.items.length > 0 && (
        <Table label={m.keys} head={[m.name, m.role, m.created, m.expires, m.used, m.state]}>
          {value.items.map((key) => (
            <KeyRow key={key.id} of={key} again={again} />
          ))}
        </Table>
      )}
      <AddKey added={again} />
    </section>
  );
}

function KeyRow({ of: key, again }: { of: ApiKey; again: () => void }) {
  const m = t.maintenance;
  const late = key.expires_at !== null && new Date(key.expires_at) <= clock.value;
  return (
    <tr>
      <th scope="row" class="text">
        {key.name}
      </th>
      <td class="text">{m.roles[key.role]}</td>
      <td class="text">{dateTime(key.created_at)}</td>
      <td class="text">{key.expires_at ? dateTime(key.expires_at) : m.never}</td>
      <td class="text">{key.used_at ? dateTime(key.used_at) : m.never}</td>
      <td class="text">
        <p>{key.revoked_at ? m.revoked : late ? m.expired : m.valid}</p>
        {!key.revoked_at && (
          <ConfirmedButton
            label={m.revokeOf(key.name)}
            disabled={!connected.value}
            act={async () => {
              await revokeKey(key.id);
              again();
            }}
          >
            {m.revokeText(key.name)}
          </ConfirmedButton>
        )}
      </td>
    </tr>
  );
}

function AddKey({ added }: { added: () => void }) {
  const m = t.maintenance;
  const name = useSignal("");
  const days = useSignal("");
  const role = useSignal<Role>("mes");
  const shown = useSignal<string | null>(null);
  const act = async () => {
    const given = days.value.trim().replace(",", ".");
    if (given !== "" && !(Number(given) > 0)) throw new Error(m.daysWrong);
    const made = await addKey({
      name: name.value.trim(),
      role: role.value,
      days: given === "" ? null : Number(given),
    });
    shown.value = made.key;
    name.value = days.value = "";
    added();
  };
  return (
    <>
      <div class="fields">
        <TextField id="key-name" label={m.name} value={name} />
        <TextField id="key-days" label={m.keyDays} value={days} numeric />
        <ChoiceField
          id="key-role"
          label={m.role}
          value={role.value}
          options={ROLE_OPTIONS}
          choose={(wanted) => {
            role.value = wanted as Role;
          }}
        />
        <ActionButton act={act} disabled={name.value.trim() === ""}>
          {m.addKey}
        </ActionButton>
      </div>
      <div role="status">
        {shown.value && (
          <p class="new-key">
            {m.keyOnce} <code>{shown.value}</code>
          </p>
        )}
      </div>
    </>
  );
}
