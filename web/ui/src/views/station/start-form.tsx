/** Two steps to move the machine: Calibrate, then confirm.  Scanner and keyboard alone are enough. */
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { type CalibrationBody, newKey, Refused, start } from "../../api";
import { connected, station } from "../../live";
import { keepOperator, operator } from "../../operator";
import { dismissOutcome } from "./outcome";

type Plan = CalibrationBody["plan"];

const PLANS: Record<Plan, string> = { paper: "Paper", rapid: "Rapid", full: "Full", diagnostic: "Find the cause" };

const serial = signal("");
const plan = signal<Plan>("paper");
/** The confirmed start's key; null while nothing waits to be confirmed. */
const armed = signal<string | null>(null);
const sending = signal(false);
const trouble = signal<{ text: string; field: string | null } | null>(null);

export function StartForm() {
  const serialField = useRef<HTMLInputElement>(null);
  const operatorField = useRef<HTMLInputElement>(null);
  const calibrateButton = useRef<HTMLButtonElement>(null);
  const confirmButton = useRef<HTMLButtonElement>(null);
  const run = station.value?.run ?? null;
  const idle = connected.value && run === null && !sending.value;

  useEffect(() => serialField.current?.focus(), []);
  useEffect(() => {
    if (armed.value) confirmButton.current?.focus();
  }, [armed.value]);
  useEffect(() => {
    if (!idle) armed.value = null;
  }, [idle]);

  useEffect(() => {
    // what had the focus may have been disabled by the run's start or end: the next scan must not get lost
    if (document.activeElement === document.body || document.activeElement?.matches(":disabled")) {
      serialField.current?.focus();
    }
  }, [run?.id]);

  const calibrate = () => {
    trouble.value = missing();
    if (trouble.value?.field === "robot_serial") serialField.current?.focus();
    else if (trouble.value?.field === "operator") operatorField.current?.focus();
    else armed.value = newKey();
  };

  const confirm = async () => {
    const key = armed.value;
    if (!key || sending.value) return;
    sending.value = true;
    try {
      await start({ robot_serial: serial.value.trim(), plan: plan.value, operator: operator.value.trim() }, key);
      keepOperator();
      trouble.value = null;
      armed.value = null;
      dismissOutcome();
      serialField.current?.focus();
    } catch (error) {
      const { message, field } = error instanceof Refused ? error : { message: String(error), field: null };
      trouble.value = { text: message, field };
    } finally {
      sending.value = false;
    }
  };

  /** A scanner ends its code with Enter: that leads to the next field that is empty. */
  const scanned = (event: SubmitEvent) => {
    event.preventDefault();
    trouble.value = null;
    if (document.activeElement === serialField.current && serial.value.trim()) dismissOutcome();
    if (!serial.value.trim()) serialField.current?.focus();
    else if (!operator.value.trim()) operatorField.current?.focus();
    else calibrateButton.current?.focus();
  };

  return (
    <section class="start" aria-label="Start a calibration">
      <form onSubmit={scanned} autocomplete="off">
        <Field name="robot_serial" label="Robot serial">
          <input
            id="robot_serial"
            ref={serialField}
            value={serial.value}
            maxLength={64}
            spellcheck={false}
            aria-describedby="trouble"
            aria-invalid={trouble.value?.field === "robot_serial"}
            onInput={(event) => {
              serial.value = event.currentTarget.value;
              armed.value = null;
            }}
          />
        </Field>
        <Field name="operator" label="Operator">
          <input
            id="operator"
            ref={operatorField}
            value={operator.value}
            maxLength={64}
            spellcheck={false}
            aria-describedby="trouble"
            aria-invalid={trouble.value?.field === "operator"}
            onInput={(event) => {
              operator.value = event.currentTarget.value;
              armed.value = null;
            }}
          />
        </Field>
        <Field name="plan" label="Plan">
          <select
            id="plan"
            value={plan.value}
            onChange={(event) => {
              plan.value = event.currentTarget.value as Plan;
              armed.value = null;
            }}
          >
            {(station.value?.station.plans ?? ["paper"]).map((name) => (
              <option value={name}>{PLANS[name]}</option>
            ))}
          </select>
        </Field>
        <button type="submit" class="hidden" tabIndex={-1} aria-hidden="true" />
      </form>
      <p id="trouble" class={trouble.value ? "trouble" : ""} role="alert">
        {trouble.value && `▲ ${trouble.value.text}`}
      </p>
      <button class="act" type="button" ref={calibrateButton} disabled={!idle || armed.value !== null} onClick={calibrate}>
        Calibrate
      </button>
      <div class="confirm" role="group" aria-label="Confirm the start" hidden={armed.value === null}>
        <p>
          <strong>Robot {serial.value.trim()} will move.</strong> Nobody within its reach?
        </p>
        <button
          class="act"
          type="button"
          ref={confirmButton}
          disabled={!idle}
          onKeyDown={(event) => event.repeat && event.preventDefault()}
          onClick={() => void confirm()}
        >
          Confirm
        </button>
        <button
          type="button"
          onClick={() => {
            armed.value = null;
            calibrateButton.current?.focus();
          }}
        >
          Back
        </button>
      </div>
    </section>
  );
}

function Field(props: { name: string; label: string; children: preact.ComponentChildren }) {
  return (
    <p class="field">
      <label for={props.name}>{props.label}</label>
      {props.children}
    </p>
  );
}

function missing(): { text: string; field: string } | null {
  if (!serial.value.trim()) return { text: "Scan or type the robot's serial.", field: "robot_serial" };
  if (!operator.value.trim()) return { text: "Scan or type who calibrates.", field: "operator" };
  return null;
}
