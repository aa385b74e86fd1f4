/** Labelled inputs, each bound to a signal. */
import type { Signal } from "@preact/signals";

interface TextProps {
  id: string;
  label: string;
  value: Signal<string>;
  type?: "text" | "password";
  numeric?: boolean;
  /** A badge that is scanned here is meant for the field and does not sign in anyone. */
  takesBadge?: boolean;
}

export function TextField({ id, label, value, type = "text", numeric, takesBadge }: TextProps) {
  return (
    <p class="field">
      <label for={id}>{label}</label>
      <input
        id={id}
        type={type as "text"}
        inputMode={numeric ? "decimal" : undefined}
        autocomplete={type === "password" ? "new-password" : "off"}
        maxLength={type === "password" ? 256 : 64}
        spellcheck={false}
        data-takes-badge={takesBadge}
        value={value.value}
        onInput={(event) => {
          value.value = event.currentTarget.value;
        }}
      />
    </p>
  );
}

interface ChoiceProps {
  id: string;
  label: string;
  value: string;
  options: [id: string, name: string][];
  choose: (id: string) => void;
  /** If a column already names it. */
  quiet?: boolean;
}

export function ChoiceField({ id, label, value, options, choose, quiet }: ChoiceProps) {
  return (
    <p class="field">
      <label for={id} class={quiet ? "hidden" : undefined}>
        {label}
      </label>
      <select id={id} value={value} onChange={(event) => choose(event.currentTarget.value)}>
        {options.map(([option, name]) => (
          <option key={option} value={option}>
            {name}
          </option>
        ))}
      </select>
    </p>
  );
}
