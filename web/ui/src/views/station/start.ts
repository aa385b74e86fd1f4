/** The input of a start. */
import { computed, signal } from "@preact/signals";
import { newKey, Refused, start } from "../../api";
import { station } from "../../live";
import { t } from "../../messages";
import { keepOperator, operator } from "../../operator";
import type { CalibrationBody, Plan } from "../../types";
import { dismissOutcome } from "./outcome";
import { forgetWishes, said } from "./wishes";

export type StartField = "robot_serial" | "operator";

export const serial = signal("");
/** Null: none was chosen, the recommended one applies. */
export const chosenPlan = signal<Plan | null>(null);
export const plan = computed<Plan>(
  () => chosenPlan.value ?? (station.value?.station.recommended_plan as Plan | undefined) ?? "full",
);
export const trouble = signal<{ text: string; field: string | null } | null>(null);
/** Number of scans that filled in a field: each one moves the focus to the missing field. */
export const scans = signal(0);

/** A scanned serial replaces the previous one; data measured at another robot are not valid for this one. */
export function takeSerial(text: string): void {
  if (serial.value.trim() && serial.value.trim() !== text) forgetWishes();
  serial.value = text;
  trouble.value = null;
  dismissOutcome();
  scans.value += 1;
}

/** The first field that is still empty. */
export function emptyField(): StartField | null {
  if (!serial.value.trim()) return "robot_serial";
  return operator.value.trim() ? null : "operator";
}

/** What has to be filled in or corrected first; null if nothing is missing. */
export function missing(): string | null {
  const field = emptyField();
  const text = field === "robot_serial" ? t.station.serialMissing : t.station.operatorMissing;
  const { wrong } = said();
  trouble.value = field ? { text, field } : wrong && { text: t.station.wishWrong, field: wrong };
  return trouble.value?.field ?? null;
}

/** The request from the present fields. */
export const body = (): CalibrationBody => ({
  robot_serial: serial.value.trim(),
  plan: plan.value,
  operator: operator.value.trim(),
  ...said().body,
});

let unanswered: { text: string; key: string } | null = null;

/** The same start after a lost answer has the same key, so that it is one run. */
function keyOf(wanted: CalibrationBody): string {
  const text = JSON.stringify(wanted);
  const key = unanswered?.text === text ? unanswered.key : newKey();
  unanswered = { text, key };
  return key;
}

/** Starts a run; a refusal is shown at its field. */
export async function begin(wanted: CalibrationBody): Promise<void> {
  try {
    await start(wanted, keyOf(wanted));
    unanswered = null;
    keepOperator();
    forgetWishes();
    trouble.value = null;
    dismissOutcome();
  } catch (error) {
    const { message, field } = error instanceof Refused ? error : { message: String(error), field: null };
    if (error instanceof Refused && error.status !== null) unanswered = null;
    trouble.value = { text: message, field };
  }
}
