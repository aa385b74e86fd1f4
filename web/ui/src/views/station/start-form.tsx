/** Two steps to move the machine: Calibrate, then confirm.  Scanner and keyboard alone are enough. */
import type { Signal } from "@preact/signals";
import type { ComponentChildren, RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { planOf } from "../../names";
import { operator } from "../../operator";
import { MotionWarning } from "../../parts/motion-warning";
import type { Plan } from "../../types";
import { dismissOutcome } from "./outcome";
import { PlanPromise } from "./plan-promise";
import {
  arm,
  armed,
  confirm,
  disarm,
  emptyField,
  plan,
  type StartField,
  sending,
  serial,
  trouble,
} from "./start";
import { WishFields } from "./wish-fields";

export function StartForm() {
  const serialField = useRef<HTMLInputElement>(null);
  const operatorField = useRef<HTMLInputElement>(null);
  const calibrateButton = useRef<HTMLButtonElement>(null);
  const confirmButton = useRef<HTMLButtonElement>(null);
  const run = station.value?.run ?? null;
  const free = connected.value && run === null;
  const idle = free && !sending.value;
  const goingBack = useRef(false);
  const focus = (field: StartField | null, otherwise?: RefObject<HTMLElement | null>) => {
    const target = { robot_serial: serialField, operator: operatorField };
    (field ? target[field] : otherwise)?.current?.focus();
  };

  useEffect(() => serialField.current?.focus(), []);
  useEffect(() => {
    if (armed.value) confirmButton.current?.focus();
    // only now is the button enabled again and can take the focus
    else if (goingBack.current) calibrateButton.current?.focus();
    goingBack.current = false;
  }, [armed.value]);
  useEffect(() => {
    // not while sending: after a lost answer the same key has to be sent again
    if (!free) disarm();
  }, [free]);
  useEffect(() => {
    // what had the focus may have been disabled by the run's start or end: the next scan must not get lost
    if (document.activeElement === document.body || document.activeElement?.matches(":disabled")) {
      serialField.current?.focus();
    }
  }, [run?.id]);

  const confirmed = async () => {
    if (await confirm()) serialField.current?.focus();
  };

  /** A scanner ends its code with Enter: that leads to the next field that is empty. */
  const scanned = (event: SubmitEvent) => {
    event.preventDefault();
    trouble.value = null;
    if (document.activeElement === serialField.current && serial.value.trim()) dismissOutcome();
    focus(emptyField(), calibrateButton);
  };

  return (
    <section class="start" aria-label={t.station.start}>
      <form onSubmit={scanned} autocomplete="off">
        <TextField name="robot_serial" label={t.station.serial} input={serialField} value={serial} />
        <TextField name="operator" label={t.shared.operator} input={operatorField} value={operator} />
        <PlanField />
        <WishFields />
        <button type="submit" class="hidden" tabIndex={-1} aria-hidden="true" />
      </form>
      <p id="plan-explanation" class="note">
        {t.plans[plan.value].text}
      </p>
      <PlanPromise />
      <p id="trouble" class={trouble.value ? "trouble" : ""} role="alert">
        {trouble.value && `▲ ${trouble.value.text}`}
      </p>
      <button
        class="act"
        type="button"
        ref={calibrateButton}
        disabled={!idle || armed.value !== null}
        onClick={() => focus(arm())}
      >
        {t.station.calibrate}
      </button>
      <div class="confirm" role="group" aria-label={t.station.confirmStart} hidden={armed.value === null}>
        <p>
          <MotionWarning serial={serial.value.trim()} />
        </p>
        <button
          class="act"
          type="button"
          ref={confirmButton}
          disabled={!idle}
          onKeyDown={(event) => event.repeat && event.preventDefault()}
          onClick={() => void confirmed()}
        >
          {t.shared.confirm}
        </button>
        <button
          type="button"
          onClick={() => {
            goingBack.current = true;
            disarm();
          }}
        >
          {t.shared.back}
        </button>
      </div>
    </section>
  );
}

interface TextFieldProps {
  name: StartField;
  label: string;
  input: RefObject<HTMLInputElement | null>;
  value: Signal<string>;
}

function TextField({ name, label, input, value }: TextFieldProps) {
  return (
    <Field name={name} label={label}>
      <input
        id={name}
        ref={input}
        value={value.value}
        maxLength={64}
        spellcheck={false}
        aria-describedby="trouble"
        aria-invalid={trouble.value?.field === name}
        onInput={(event) => {
          value.value = event.currentTarget.value;
          disarm();
        }}
      />
    </Field>
  );
}

function PlanField() {
  return (
    <Field name="plan" label={t.station.plan}>
      <select
        id="plan"
        value={plan.value}
        aria-describedby="plan-explanation"
        onChange={(event) => {
          plan.value = event.currentTarget.value as Plan;
          disarm();
        }}
      >
        {(station.value?.station.plans ?? ["paper"]).map((name) => (
          <option key={name} value={name}>
            {planOf(name)?.name ?? name}
          </option>
        ))}
      </select>
    </Field>
  );
}

function Field(props: { name: string; label: string; children: ComponentChildren }) {
  return (
    <p class="field">
      <label for={props.name}>{props.label}</label>
      {props.children}
    </p>
  );
}
