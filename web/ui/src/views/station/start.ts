/** What a start needs, and its two steps: arm, then confirm. */
import { signal } from "@preact/signals";
import { newKey, Refused, start } from "../../api";
import { t } from "../../messages";
import { keepOperator, operator } from "../../operator";
import type { Plan } from "../../types";
import { dismissOutcome } from "./outcome";
import { forgetWishes, said } from "./wishes";

export type StartField = "robot_serial" | "operator";

export const serial = signal("");
export const plan = signal<Plan>("paper");
/** The confirmed start's key; null while nothing waits to be confirmed. */
export const armed = signal<string | null>(null);
export const sending = signal(false);
export const trouble = signal<{ text: string; field: string | null } | null>(null);

/** The first field that is still empty. */
export function emptyField(): StartField | null {
  if (!serial.value.trim()) return "robot_serial";
  return operator.value.trim() ? null : "operator";
}

/** Waits for the confirmation if nothing is missing; else answers the field that is. */
export function arm(): StartField | null {
  const field = emptyField();
  const text = field === "robot_serial" ? t.station.serialMissing : t.station.operatorMissing;
  trouble.value = field && { text, field };
  if (field) return field;
  const { wrong } = said();
  if (wrong) trouble.value = { text: t.station.wishWrong, field: wrong };
  else armed.value = newKey();
  return null;
}

export function disarm(): void {
  armed.value = null;
}

/** Starts what is armed; answers whether it did.  After a refusal the same start can be confirmed again. */
export async function confirm(): Promise<boolean> {
  const key = armed.value;
  if (!key || sending.value) return false;
  sending.value = true;
  try {
    const body = {
      robot_serial: serial.value.trim(),
      plan: plan.value,
      operator: operator.value.trim(),
      ...said().body,
    };
    await start(body, key);
    keepOperator();
    forgetWishes();
    trouble.value = null;
    disarm();
    dismissOutcome();
    return true;
  } catch (error) {
    const { message, field } = error instanceof Refused ? error : { message: String(error), field: null };
    trouble.value = { text: message, field };
    return false;
  } finally {
    sending.value = false;
  }
}
