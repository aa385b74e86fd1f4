/** The language of the page: chosen at this browser, else the browser's own, else English. */

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
    return null; // a browser that keeps nothing
  }
}

export const language = preferred(keptHere(), navigator.languages);

/** The address stays: the page begins anew in the other language where it was. */
export function choose(chosen: Language): void {
  try {
    localStorage.setItem(KEPT, chosen);
  } finally {
    location.reload();
  }
}
