/** Numbers and times in the operator's format; a dash in place of a value that is not a number. */

import { writing } from "./messages/language";

export const MISSING = "–";

/** A formatted number, with the decimal sign of the language. */
export const local = (text: string) => (writing.decimalComma ? text.replace(".", ",") : text);

export function fixed(value: number | null | undefined, digits: number): string {
  if (value == null || !Number.isFinite(value)) return MISSING;
  const text = value.toFixed(digits);
  // a real minus sign, as wide as the plus; none before a zero
  return local(Number(text) === 0 ? text.replace("-", "") : text.replace("-", "\u2212"));
}

export function signed(value: number | null | undefined, digits: number): string {
  const text = fixed(value, digits);
  return value != null && Number(value.toFixed(digits)) > 0 ? `+${text}` : text;
}

/** With this many significant digits, without zeros at the end. */
export function significant(value: number | null | undefined, digits: number): string {
  if (value == null || !Number.isFinite(value)) return MISSING;
  return local(String(Number(value.toPrecision(digits))).replace("-", "\u2212"));
}

const UM_PER_MM = 1000;

/** Errors of length are stated in µm on every page. */
export function micrometres(mm: number | null | undefined, digits: number): string {
  return fixed(mm == null ? null : UM_PER_MM * mm, digits);
}

export function signedMicrometres(mm: number | null | undefined, digits: number): string {
  return signed(mm == null ? null : UM_PER_MM * mm, digits);
}

/** Coverage factor of every expanded uncertainty U on the page. */
export const K = 2;

/** Twice the standard uncertainty. */
export const expanded = (sd: number | null) => (sd === null ? null : K * sd);

/** Value ± U, to two digits of U. */
export function measured(value: number | null, u: number | null): string {
  if (value === null || !Number.isFinite(value)) return MISSING;
  if (u === null || !(u > 0)) return local(String(Number(value.toPrecision(6))).replace("-", "\u2212"));
  const digits = Math.min(Math.max(1 - Math.floor(Math.log10(u)), 0), 9);
  return `${fixed(value, digits)} ± ${fixed(u, digits)}`;
}

/** Value ± U with its unit, from the standard uncertainty; it does not break before the unit. */
export const quantity = (value: number | null, sd: number | null, unit: string) =>
  `${measured(value, expanded(sd))}${unit && "\u00a0"}${unit}`;

/** A probability or a share; never 0 or 100 % unless it is. */
export function percent(part: number | null | undefined): string {
  if (part == null || !Number.isFinite(part)) return MISSING;
  if (part > 0 && part < 0.01) return "< 1 %";
  if (part < 1 && part > 0.99) return "> 99 %";
  return `${fixed(100 * part, 0)} %`;
}

const pad = (part: number) => String(part).padStart(2, "0");

export function timeOfDay(time: Date): string {
  return `${pad(time.getHours())}:${pad(time.getMinutes())}:${pad(time.getSeconds())}`;
}

export function dateTime(iso: string | null | undefined): string {
  if (!iso) return MISSING;
  const time = new Date(iso);
  return `${dateOf(time)} ${timeOfDay(time)}`;
}

function dateOf(time: Date): string {
  return writing.date(String(time.getFullYear()), pad(time.getMonth() + 1), pad(time.getDate()));
}

/** Difference of this computer's clock from UTC: all times of the page are in its zone. */
export function zone(time: Date): string {
  const minutes = -time.getTimezoneOffset();
  const [hours, rest] = [Math.floor(Math.abs(minutes) / 60), Math.abs(minutes) % 60];
  return `UTC${minutes < 0 ? "\u2212" : "+"}${pad(hours)}:${pad(rest)}`;
}

export function duration(seconds: number | null | undefined): string {
  if (seconds == null) return MISSING;
  const whole = Math.round(seconds);
  return whole < 60 ? `${whole} s` : `${Math.floor(whole / 60)} min ${pad(whole % 60)} s`;
}
