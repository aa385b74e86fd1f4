/** Two steps to move the machine: Calibrate, then confirm. A scan fills in fields; it starts nothing. */
import type { Signal } from "@preact/signals";
import type { ComponentChildren, RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { planOf } from "../../names";
import { operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { MotionWarning } from "../../parts/motion-warning";
import { navigations } from "../../router";
import type { Plan } from "../../types";
import { dismissOutcome } from "./outcome";
import { PlanPromise } from "./plan-promise";
import {
  begin,
  body,
  chosenPlan,
  emptyField,
  missing,
  plan,
  type StartField,
  scans,
  serial,
  trouble,
} from "./start";
import { AccuracyField, References } from "./wish-fields";

/** Scans that moved the focus to the missing field. */
let ledOn = 0;

export function StartForm() {
  const serialField = useRef<HTMLInputElement>(null);
  const operatorField = useRef<HTMLInputElement>(null);
  const calibrateButton = useRef<HTMLButtonElement>(null);
  const run = station.value?.run ?? null;
  const wanted = body();
  const focus = (field: string | null, otherwise?: RefObject<HTMLElement | null>) => {
    if (field === "robot_serial") serialField.current?.focus();
    else if (field === "operator") operatorField.current?.focus();
    else if (field === null) otherwise?.current?.focus();
  };

  useEffect(() => {
    if (scans.value > ledOn) focus(emptyField(), calibrateButton);
    else if (navigations.peek() === 0) serialField.current?.focus();
    ledOn = scans.value;
  }, [scans.value]);
  useEffect(() => {
    // the focused field may have been disabled by the run's start or end: the next input must not get lost
    if (document.activeElement === document.body || document.activeElement?.matches(":disabled")) {
      serialField.current?.focus();
    }
  }, [run?.id]);

  /** Enter moves to the next empty field; it never starts anything. */
  const entered = (event: SubmitEvent) => {
    event.preventDefault();
    trouble.value = null;
    if (document.activeElement === serialField.current && serial.value.trim()) dismissOutcome();
    focus(emptyField(), calibrateButton);
  };

  return (
    <section class="start" aria-label={t.station.start}>
      <form onSubmit={entered} autocomplete="off">
        <TextField name="robot_serial" label={t.station.serial} input={serialField} value={serial} />
        <TextField name="operator" label={t.shared.operator} input={operatorField} value={operator} />
        <AccuracyField />
        <PlanField />
        <References />
        <button type="submit" class="hidden" tabIndex={-1} aria-hidden="true" />
      </form>
      <p id="plan-explanation" class="note">
        {t.plans[plan.value].text}
      </p>
      <PlanPromise />
      <p id="trouble" class={trouble.value ? "trouble" : ""} role="alert">
        {trouble.value && `▲ ${trouble.value.text}`}
      </p>
      <ConfirmedButton
        label={t.station.calibrate}
        prominent
        disabled={!connected.value || run !== null}
        button={calibrateButton}
        about={JSON.stringify(wanted)}
        check={() => {
          const field = missing();
          focus(field);
          return field === null;
        }}
        act={() => begin(wanted)}
      >
        <MotionWarning serial={wanted.robot_serial} />
      </ConfirmedButton>
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
        }}
      />
    </Field>
  );
}

function PlanField() {
  return (
    <Field name="plan" label={t.station.plan} wide>
      <select
        id="plan"
        value={plan.value}
        aria-describedby="plan-explanation"
        onChange={(event) => {
          chosenPlan.value = event.currentTarget.value as Plan;
        }}
      >
        {(station.value?.station.plans ?? [plan.value]).map((name) => (
          <option key={name} value={name}>
            {name === station.value?.station.recommended_plan
              ? t.station.recommended(planOf(name)?.name ?? name)
              : (planOf(name)?.name ?? name)}
          </option>
        ))}
      </select>
    </Field>
  );
}

function Field(props: { name: string; label: string; wide?: boolean; children: ComponentChildren }) {
  return (
    <p class={props.wide ? "field wide" : "field"}>
      <label for={props.name}>{props.label}</label>
      {props.children}
    </p>
  );
}
