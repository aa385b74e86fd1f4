/** The name of the user at this page; stored as long as its tab is open. */
import { signal } from "@preact/signals";

const OPERATOR = "operator";

export const operator = signal(sessionStorage.getItem(OPERATOR) ?? "");

export function keepOperator(): void {
  sessionStorage.setItem(OPERATOR, operator.value.trim());
}
