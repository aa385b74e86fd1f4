/** The language of the page: chosen in this browser, otherwise the browser's own, otherwise English. */

export const LANGUAGES = { en: "English", de: "Deutsch", zh: "中文" } as const;

export type Language = keyof typeof LANGUAGES;

const KEPT = "language";

const known = (tag: string | null | undefined): Language | undefined =>
  (Object.keys(LANGUAGES) as Language[]).find((one) => tag?.toLowerCase().split("-")[0] === one);

export function preferred(kept: string | null, browser: readonly string[]): Language {
  return known(kept) ?? browser.map(known).find((one) => one !== undefined) ?? "en";
}

function keptHere(): string | null {
  try {
    return localStorage.getItem(KEPT);
  } catch {
    return null; // a browser without storage
  }
}

export const language = preferred(keptHere(), navigator.languages);

/** Formats that differ between languages. */
interface Writing {
  decimalComma: boolean;
  /** From texts of year, month and day. */
  date: (year: string, month: string, day: string) => string;
  /** Between two sentences. */
  between: string;
  /** Whether names keep their capital in the middle of a sentence. */
  capitals: boolean;
}

const byYear = (year: string, month: string, day: string) => `${year}-${month}-${day}`;
const byDay = (year: string, month: string, day: string) => `${day}.${month}.${year}`;

const WRITING: Record<Language, Writing> = {
  en: { decimalComma: false, date: byYear, between: " ", capitals: false },
  de: { decimalComma: true, date: byDay, between: " ", capitals: true },
  zh: { decimalComma: false, date: byYear, between: "", capitals: false },
};

export const writing = WRITING[language];

/** The address is unchanged: the page reloads in the other language at the same view. */
export function choose(chosen: Language): void {
  try {
    localStorage.setItem(KEPT, chosen);
  } finally {
    location.reload();
  }
}
