/** What the station says in English only, in the page's language. */
import { local } from "../format";
import { t } from "./index";
import { language } from "./language";

const BETWEEN = /(?<=[.?!]) (?=[A-Z])/;
const NUMBER = /\d+(?:\.\d+)?/g;
const PLACE = /\{\}/g;

/** Sentence by sentence; one that is not known stays as it is. */
export const said = (text: string) =>
  whole(text) ??
  text
    .split(BETWEEN)
    .map((one) => whole(one) ?? one)
    .join(language === "zh" ? "" : " ");

function whole(sentence: string): string | undefined {
  const numbers = sentence.match(NUMBER) ?? [];
  const key = sentence.replace(NUMBER, "{}");
  const known = Object.hasOwn(t.sentences, key) ? t.sentences[key] : undefined;
  let next = 0;
  return known?.replace(PLACE, () => local(numbers[next++] ?? ""));
}
