/** English-only texts of the station, in the page's language. */
import { local } from "../format";
import { t } from "./index";
import { writing } from "./language";

const BETWEEN = /(?<=[.?!]) (?=[A-Z])/;
/**
 * Template of a sentence: `{}` stands for a number, `{name}` for words, `{name_text}` for whole sentences.
 */
const PLACE = /\{(\w*)\}/g;
const NUMBER = "([+-]?\\d+(?:\\.\\d+)?)";
const WORDS = "((?:(?![.?!] [A-Z]).)+?)";
const SENTENCES = "(.+?)";
const ANGLE = /([\d.]) deg\b/g;
const IS_NUMBER = /^[+-]?\d+(?:\.\d+)?$/;
/** A template with fewer letters could match any text: one of its values has to be known as well. */
const FEW_LETTERS = 4;

interface Sentence {
  form: RegExp;
  places: string[];
  letters: number;
  text: string;
}

/** Templates with the most fixed words first. */
const known: Sentence[] = Object.entries(t.sentences)
  .map(([english, text]) => {
    const own = english.split(/\{\w*\}/);
    const places = [...english.matchAll(PLACE)].map(([, name]) => name!);
    const form = own.map(escaped).reduce((before, after, n) => {
      const name = places[n - 1]!;
      return before + (name === "" ? NUMBER : name.endsWith("_text") ? SENTENCES : WORDS) + after;
    });
    const letters = own.join("").replace(/[^A-Za-z]/g, "").length;
    return { form: new RegExp(`^${form}$`), places, letters, text };
  })
  .sort((a, b) => b.letters - a.letters);

function escaped(text: string): string {
  return text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
}

const answers = new Map<string, string>();

/** As few known pieces as possible; an unknown sentence is unchanged. */
export function said(text: string): string {
  let answer = answers.get(text);
  if (answer === undefined) {
    answer = inPieces(text)
      .replace(ANGLE, "$1°")
      .replace(/(^|[ (])-(?=[\d.]+°)/g, "$1−");
    answers.set(text, answer);
  }
  return answer;
}

function inPieces(text: string): string {
  const sentences = text.split(BETWEEN);
  const pieces: string[] = [];
  for (let from = 0; from < sentences.length; ) {
    let to = sentences.length;
    let piece: string | undefined;
    for (; to > from && piece === undefined; to--) piece = whole(sentences.slice(from, to).join(" "));
    pieces.push(piece ?? sentences[from]!);
    from = piece === undefined ? from + 1 : to + 1;
  }
  return pieces.join(writing.between);
}

function whole(text: string): string | undefined {
  for (const { form, places, letters, text: template } of known) {
    const found = form.exec(text);
    if (!found) continue;
    const values = found.slice(1);
    const words = values.map(value);
    if (letters < FEW_LETTERS && values.length > 0 && words.every((word, n) => word === values[n])) continue;
    let numbers = 0;
    return template.replace(PLACE, (_, name: string) => {
      if (name !== "") return words[places.indexOf(name)]!;
      while (places[numbers] !== "") numbers += 1;
      return words[numbers++]!;
    });
  }
  return undefined;
}

/** A number, a device, or another text of the station. */
function value(text: string): string {
  if (IS_NUMBER.test(text)) return local(text).replace("-", "−");
  if (text === "deg") return "°";
  const device = text.charAt(0).toLowerCase() + text.slice(1);
  return (Object.hasOwn(t.deviceNames, device) && deviceNames[device]) || inPieces(text);
}

const deviceNames: Record<string, string> = t.deviceNames;
