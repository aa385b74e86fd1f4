import { t } from "../messages";
import { operator } from "../operator";

/** The name of the user at this page; shared by all fields that ask for it. */
export function OperatorField({ id }: { id: string }) {
  return (
    <p class="field">
      <label for={id}>{t.shared.operator}</label>
      <input
        id={id}
        value={operator.value}
        maxLength={64}
        spellcheck={false}
        onInput={(event) => {
          operator.value = event.currentTarget.value;
        }}
      />
    </p>
  );
}
