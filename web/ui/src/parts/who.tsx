import { station } from "../live";
import { t } from "../messages";
import { session, signOut } from "../session";

/** The signed-in user, with sign-out; or the note that no sign-in is needed. */
export function Who() {
  if (station.value?.station.open) return <p class="who">{t.signIn.open}</p>;
  const known = session.value;
  if (!known) return null;
  return (
    <p class="who">
      {t.signIn.as(known.name, known.role ? t.maintenance.roles[known.role] : "")}{" "}
      <button type="button" onClick={() => void signOut()}>
        {t.signIn.out}
      </button>
    </p>
  );
}
