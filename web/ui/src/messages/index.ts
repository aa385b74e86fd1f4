/** The texts of the page in the operator's language; only that one is loaded. */
import type { en } from "./en";
import { type Language, language } from "./language";

/** The shape of every language: a key that is missing, or one too many, does not compile. */
export type Messages = typeof en;

const TEXTS: Record<Language, () => Promise<Messages>> = {
  en: async () => (await import("./en")).en,
  de: async () => (await import("./de")).de,
  zh: async () => (await import("./zh")).zh,
};

export const t: Messages = await TEXTS[language]();
