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

/** The address is unchanged: the page reloads in the other language at the same view. */
export function choose(chosen: Language): void {
  try {
    localStorage.setItem(KEPT, chosen);
  } finally {
    location.reload();
  }
}
