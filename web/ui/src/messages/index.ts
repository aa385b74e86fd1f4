/** The texts of the page in the operator's language. */
import { en } from "./en";

/** The shape of every language: a key that is missing, or one too many, does not compile. */
export type Messages = typeof en;

export const t: Messages = en;
