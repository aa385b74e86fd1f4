/** Name and password; with the link of the first start it makes the first administrator. */
import { useSignal } from "@preact/signals";
import { Refused } from "../../api";
import { t } from "../../messages";
import { navigate } from "../../router";
import { makeFirst, signIn } from "../../session";

const FIRST = "#first=";

export function SignInView() {
  const secret = location.hash.startsWith(FIRST) ? location.hash.slice(FIRST.length) : null;
  const name = useSignal("");
  const password = useSignal("");
  const refused = useSignal("");

  async function submit(event: Event): Promise<void> {
    event.preventDefault();
    refused.value = "";
    try {
      if (secret) await makeFirst(secret, name.value, password.value);
      else await signIn(name.value, password.value);
      navigate("/", { replace: true });
    } catch (error) {
      refused.value = error instanceof Refused ? error.message : String(error);
    }
    password.value = "";
  }

  return (
    <form class="panel sign-in" onSubmit={(event) => void submit(event)}>
      <h1>{secret ? t.signIn.first : t.signIn.title}</h1>
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
      <p class="field">
        <label for="password">{t.signIn.password}</label>
        <input
          id="password"
          type="password"
          autocomplete={secret ? "new-password" : "current-password"}
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
      <p class="alarm warn" role="alert" hidden={!refused.value}>
        {refused.value}
      </p>
      <p>{t.signIn.stopWithout}</p>
    </form>
  );
}
