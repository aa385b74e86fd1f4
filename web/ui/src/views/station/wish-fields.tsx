import { t } from "../../messages";
import { trouble } from "./start";
import { type Wish, wishes } from "./wishes";

/** The required accuracy of the robot; without one the tolerances decide. */
export const AccuracyField = () => (
  <NumberField name="accuracy" label={t.station.accuracy} hint={t.station.optional} />
);

/** In a fold: few runs need them. */
export function References() {
  return (
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
  );
}

function NumberField({ name, label, hint }: { name: Wish; label: string; hint?: string }) {
  return (
    <p class="field">
      <label for={name}>{label}</label>
      <input
        id={name}
        inputMode="decimal"
        placeholder={hint}
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
