/** Name and password, or badge and PIN; with the link of the first start it makes the first administrator. */
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Refused, signInWays } from "../../api";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import { navigate } from "../../router";
import { badge, makeFirst, PROVIDER, session, signIn, signInByBadge } from "../../session";

const FIRST = "#first=";
const REFUSED = "#refused=";

/** Why the plant's provider did not sign in anyone. */
function refusedThere(): string {
  const why = location.hash.startsWith(REFUSED) ? location.hash.slice(REFUSED.length) : "";
  const known: Record<string, string> = t.signIn.refused;
  return why && (known[why] ?? t.signIn.refused.not_valid);
}

export function SignInView() {
  const secret = location.hash.startsWith(FIRST) ? location.hash.slice(FIRST.length) : null;
  const name = useSignal("");
  const password = useSignal("");
  const refused = useSignal(refusedThere());
  const ways = useLoaded("", signInWays).value.value;
  const secretField = useRef<HTMLInputElement>(null);
  const byBadge = badge.value !== null;

  useEffect(() => {
    password.value = "";
    if (!badge.value) return;
    refused.value = "";
    secretField.current?.focus();
  }, [badge.value]);

  async function submit(event: Event): Promise<void> {
    event.preventDefault();
    refused.value = "";
    const begins = !session.value;
    try {
      if (byBadge) await signInByBadge(password.value);
      else if (secret) await makeFirst(secret, name.value, password.value);
      else await signIn(name.value, password.value);
      if (begins) navigate("/", { replace: true });
    } catch (error) {
      refused.value = error instanceof Refused ? error.message : String(error);
    }
    password.value = "";
  }

  return (
    <form class="panel sign-in" onSubmit={(event) => void submit(event)}>
      <h1>{byBadge ? t.signIn.badge : secret ? t.signIn.first : t.signIn.title}</h1>
      {!byBadge && (
        <p class="field">
          <label for="name">{t.signIn.name}</label>
          <input
            id="name"
            autocomplete="username"
            required
            maxLength={64}
            value={name.value}
            onInput={(event) => {
              name.value = event.currentTarget.value;
            }}
          />
        </p>
      )}
      <p class="field">
        <label for="password">{byBadge ? t.signIn.pin : t.signIn.password}</label>
        <input
          id="password"
          ref={secretField}
          type="password"
          inputMode={byBadge ? "numeric" : undefined}
          autocomplete={byBadge ? "off" : secret ? "new-password" : "current-password"}
          required
          value={password.value}
          onInput={(event) => {
            password.value = event.currentTarget.value;
          }}
        />
      </p>
      <button class="act" type="submit">
        {t.signIn.button}
      </button>
      {byBadge && (
        <button
          type="button"
          onClick={() => {
            refused.value = "";
            badge.value = null;
          }}
        >
          {t.shared.back}
        </button>
      )}
      <p class="alarm warn" role="alert" hidden={!refused.value}>
        {refused.value}
      </p>
      {!byBadge && !secret && ways?.openid && (
        <p>
          <a class="button" href={PROVIDER}>
            {t.signIn.withProvider(ways.openid)}
          </a>
        </p>
      )}
      {!byBadge && !secret && <p>{t.signIn.scanBadge}</p>}
      <p>{t.signIn.stopWithout}</p>
    </form>
  );
}
