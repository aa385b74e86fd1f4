import { t } from "../../messages";
import { trouble } from "./start";
import { type Wish, wishes } from "./wishes";

/** The wanted accuracy, and references behind a fold: few runs have any. */
export function WishFields() {
  return (
    <>
      <NumberField name="accuracy" label={t.station.accuracy} />
      <details class="references">
        <summary>{t.station.references}</summary>
        <p class="field">
          <label for="joint">{t.station.joint}</label>
          <select
            id="joint"
            value={wishes.joint.value}
            onChange={(event) => {
              wishes.joint.value = event.currentTarget.value;
            }}
          >
            <option value="1">1</option>
            <option value="2">2</option>
          </select>
        </p>
        <NumberField name="at" label={t.station.driveSays} />
        <NumberField name="reads" label={t.station.levelReads} />
        <NumberField name="sd" label={t.station.levelSd} />
        <NumberField name="mounting" label={t.station.mounting} />
        <NumberField name="mountingSd" label={t.station.mountingSd} />
      </details>
    </>
  );
}

function NumberField({ name, label }: { name: Wish; label: string }) {
  return (
    <p class={`field ${name === "accuracy" ? "wide" : ""}`}>
      <label for={name}>{label}</label>
      <input
        id={name}
        inputMode="decimal"
        value={wishes[name].value}
        maxLength={16}
        aria-describedby="trouble"
        aria-invalid={trouble.value?.field === name}
        onInput={(event) => {
          wishes[name].value = event.currentTarget.value;
        }}
      />
    </p>
  );
}
