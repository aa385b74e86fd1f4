/** A new password, badge or PIN for an existing user. */
import { useSignal } from "@preact/signals";
import { connected } from "../../live";
import { t } from "../../messages";
import { ConfirmedButton } from "../../parts/confirm";
import type { User } from "../../types";
import { ActionButton } from "./action";
import { changeUser, type UserChange } from "./calls";
import { ChoiceField, TextField } from "./fields";

export function SignInOf({ users, changed }: { users: User[]; changed: () => void }) {
  const m = t.maintenance;
  const own = users.filter((user) => !user.by_provider);
  const chosen = useSignal("");
  const password = useSignal("");
  const badge = useSignal("");
  const pin = useSignal("");
  const done = useSignal("");
  const user = own.find(({ id }) => String(id) === chosen.value) ?? own[0];
  if (!user) return null;
  const change = async (what: UserChange, said: string) => {
    done.value = "";
    await changeUser(user.id, what);
    password.value = badge.value = pin.value = "";
    done.value = said;
    changed();
  };
  const save = () =>
    change(
      {
        ...(password.value && { password: password.value }),
        ...(badge.value.trim() && { badge: badge.value.trim() }),
        ...(pin.value && { pin: pin.value }),
      },
      m.signInSaved(user.name),
    );
  return (
    <>
      <h3>{m.signInOf}</h3>
      <p class="note">{m.signInNote}</p>
      <div class="fields">
        <ChoiceField
          id="sign-in-user"
          label={m.user}
          value={String(user.id)}
          options={own.map(({ id, name }) => [String(id), name])}
          choose={(id) => {
            chosen.value = id;
            // the typed text was meant for the user chosen before
            password.value = badge.value = pin.value = done.value = "";
          }}
        />
        <TextField id="sign-in-password" label={m.newPassword} value={password} type="password" />
        <TextField id="sign-in-badge" label={m.newBadge} value={badge} takesBadge />
        <TextField id="sign-in-pin" label={m.newPin} value={pin} type="password" />
        <ActionButton act={save} disabled={!(password.value || badge.value.trim() || pin.value)}>
          {m.saveSignIn}
        </ActionButton>
      </div>
      <ConfirmedButton
        label={m.removeBadge}
        disabled={!user.has_badge || !connected.value}
        about={chosen.value}
        act={() => change({ remove_badge: true }, m.badgeRemoved(user.name))}
      >
        {m.removeBadgeText(user.name)}
      </ConfirmedButton>
      <p class="note" role="status">
        {done.value}
      </p>
    </>
  );
}
