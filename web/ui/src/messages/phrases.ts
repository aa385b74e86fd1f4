/** Templates of sentences composed of parts; loaded when the first one is shown. */
import { signal } from "@preact/signals";
import { type Language, language } from "./language";

type Templates = Record<string, string>;

const FILES: Record<Language, () => Promise<{ default: Templates }>> = {
  en: () => import("../../../../station/messages/en-phrases.json"),
  de: () => import("../../../../station/messages/de-phrases.json"),
  zh: () => import("../../../../station/messages/zh-phrases.json"),
};

const templates = signal<Templates | null>(null);
let asked: Promise<void> | null = null;

/** Loaded once; after a failure again when the next one is shown. */
export function loadPhrases(): Promise<void> {
  asked ??= FILES[language]()
    .then((file) => {
      templates.value = file.default;
    })
    .catch(() => {
      asked = null;
    });
  return asked;
}

/** Null until they are loaded, and for an unknown code; its users are redrawn then. */
export function template(code: string): string | null {
  if (templates.value === null) void loadPhrases();
  const known = templates.value;
  return known && Object.hasOwn(known, code) ? known[code]! : null;
}
