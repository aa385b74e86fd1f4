/** Who works at this page; kept as long as its tab. */
import { signal } from "@preact/signals";

const OPERATOR = "operator";

export const operator = signal(sessionStorage.getItem(OPERATOR) ?? "");

export function keepOperator(): void {
  sessionStorage.setItem(OPERATOR, operator.value.trim());
}
