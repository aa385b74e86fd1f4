/** People who sign in at the page. */
import { useSignal } from "@preact/signals";
import { dateTime } from "../../format";
import { connected } from "../../live";
import { t } from "../../messages";
import { ConfirmedButton } from "../../parts/confirm";
import { useLoaded } from "../../parts/load";
import type { Role, User } from "../../types";
import { ActionButton, Pending } from "./action";
import { addUser, changeUser, removeUser, users } from "./calls";
import { ChoiceField, TextField } from "./fields";
import { SignInOf } from "./sign-in-of";
import { Table } from "./table";

export const ROLE_OPTIONS = Object.entries(t.maintenance.roles) as [Role, string][];

export function Users() {
  const m = t.maintenance;
  const changed = useSignal(0);
  const trouble = useSignal<string | null>(null);
  const { value, trouble: missing } = useLoaded(String(changed.value), users).value;
  const again = () => {
    changed.value += 1;
  };
  const change = async (id: number, what: { role?: Role; disabled?: boolean }) => {
    trouble.value = await changeUser(id, what).then(
      () => null,
      (error: Error) => error.message,
    );
    again();
  };
  return (
    <section class="panel part" aria-labelledby="users-title">
      <h2 id="users-title">{m.users}</h2>
      {!value && <Pending trouble={missing} />}
      {value?.items.length === 0 && <p class="empty">{m.noUsers}</p>}
      {value && value.items.length > 0 && (
        <Table label={m.users} head={[m.name, m.role, m.badge, m.created, m.state]}>
          {value.items.map((user) => (
            <UserRow key={user.id} user={user} change={change} removed={again} />
          ))}
        </Table>
      )}
      <p class="trouble" role="alert">
        {trouble.value && `▲ ${trouble.value}`}
      </p>
      <AddUser added={again} />
      {value && value.items.length > 0 && <SignInOf users={value.items} changed={again} />}
    </section>
  );
}

interface RowProps {
  user: User;
  change: (id: number, what: { role?: Role; disabled?: boolean }) => Promise<void>;
  removed: () => void;
}

/** A user is disabled before being removed: one press by mistake can be taken back. */
function UserRow({ user, change, removed }: RowProps) {
  const m = t.maintenance;
  return (
    <tr>
      <th scope="row" class="text">
        {user.name}
      </th>
      <td class="text">
        <ChoiceField
          id={`role-${user.id}`}
          label={m.roleOf(user.name)}
          quiet
          value={user.role}
          options={ROLE_OPTIONS}
          choose={(role) => void change(user.id, { role: role as Role })}
        />
      </td>
      <td class="text">{user.by_provider ? m.byProvider : user.has_badge ? m.yes : m.no}</td>
      <td class="text">{dateTime(user.created_at)}</td>
      <td class="text">
        <p>{user.disabled ? m.disabled : m.enabled}</p>
        {user.disabled ? (
          <div class="actions">
            <ActionButton label={m.enableOf(user.name)} act={() => change(user.id, { disabled: false })}>
              {m.enable}
            </ActionButton>
            <ConfirmedButton
              label={m.removeOf(user.name)}
              disabled={!connected.value}
              act={() => removeUser(user.id).then(removed)}
            >
              {m.removeText(user.name)}
            </ConfirmedButton>
          </div>
        ) : (
          <ConfirmedButton
            label={m.disableOf(user.name)}
            disabled={!connected.value}
            act={() => change(user.id, { disabled: true })}
          >
            {m.disableText(user.name)}
          </ConfirmedButton>
        )}
      </td>
    </tr>
  );
}

function AddUser({ added }: { added: () => void }) {
  const m = t.maintenance;
  const name = useSignal("");
  const password = useSignal("");
  const badge = useSignal("");
  const pin = useSignal("");
  const role = useSignal<Role>("operator");
  const act = async () => {
    await addUser({
      name: name.value.trim(),
      role: role.value,
      password: password.value || null,
      badge: badge.value.trim() || null,
      pin: pin.value || null,
    });
    name.value = password.value = badge.value = pin.value = "";
    added();
  };
  const waysIn = password.value !== "" || (badge.value.trim() !== "" && pin.value !== "");
  return (
    <div class="fields">
      <TextField id="user-name" label={m.name} value={name} />
      <TextField id="user-password" label={m.password} value={password} type="password" />
      <TextField id="user-badge" label={m.badgeText} value={badge} takesBadge />
      <TextField id="user-pin" label={m.badgePin} value={pin} type="password" />
      <ChoiceField
        id="user-role"
        label={m.role}
        value={role.value}
        options={ROLE_OPTIONS}
        choose={(wanted) => {
          role.value = wanted as Role;
        }}
      />
      <ActionButton act={act} disabled={name.value.trim() === "" || !waysIn}>
        {m.addUser}
      </ActionButton>
    </div>
  );
}
