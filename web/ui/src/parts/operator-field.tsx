import { t } from "../messages";
import { operator } from "../operator";

/** Who is at this page; one name wherever it is asked for. */
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
