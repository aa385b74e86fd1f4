import { describe, expect, it } from "vitest";
import openapi from "../../openapi.json";
import { type Messages, t } from "../src/messages";
import { LANGUAGES, preferred } from "../src/messages/language";
import { parameter } from "../src/names";

const others: [string, Messages][] = await Promise.all(
  Object.keys(LANGUAGES)
    .filter((tag) => tag !== "en")
    .map(async (tag): Promise<[string, Messages]> => [tag, (await import(`../src/messages/${tag}.ts`))[tag]]),
);

/** Of a template. */
const FIELD = /\{\w+(:[^}]*)?\}/g;

/** Every text with its path; functions are asked with a value that can be found again. */
function texts(node: unknown, path = ""): [string, string][] {
  if (typeof node === "string") return [[path, node.replace(FIELD, "7")]];
  if (typeof node === "function") return [[path, String(node(...sample(node)))]];
  return Object.entries(node as object)
    .filter(([key]) => key !== "sentences") // keys are the station's English: said.test.ts
    .flatMap(([key, value]) => texts(value, `${path}.${key}`));
}

const LISTS = new Set<unknown>(
  [t, ...others.map(([, texts]) => texts)].flatMap(({ listed, both, maintenance }) => [
    listed,
    both,
    maintenance.either,
  ]),
);
const sample = (message: { length: number }) =>
  LISTS.has(message) ? [["7"]] : Array.from({ length: message.length }, () => "7");

const all = texts(t);

describe("texts", () => {
  it("are never empty, but for a unit of one", () => {
    const empty = all.filter(([, text]) => text.trim() === "");
    expect(empty).toEqual([]);
  });

  it("have no private words and no internal names", () => {
    const PRIVATE =
      /\b(walks?|rests?|rivals?|told|tells?|apart|look-?alikes?|places?|dirt|rM[xy]|mu|um|deg|sd|\w+_\w+)\b/i;
    expect(all.filter(([, text]) => PRIVATE.test(text))).toEqual([]);
  });

  it("explain in whole sentences", () => {
    const explanations = all.filter(([path]) => path.endsWith(".text") && path !== "");
    expect(explanations.length).toBeGreaterThan(90);
    expect(explanations.filter(([, text]) => !/^[A-Z0-9].*\.$/.test(text))).toEqual([]);
  });

  it("show every value that they are given", () => {
    expect(t.diagnosis.planned(3, "1", "2", "4", "5")).toBe(
      "3 planned positions, x from 1 to 2 mm, y from 4 to 5 mm",
    );
    expect(t.result.residualsNote(8, "9.0", 0)).toContain("none exceeds its limit");
    expect(t.result.residualsNote(8, "9.0", 2)).toContain("2 over the limit");
  });
});

// another language must have the same keys of the same kind: checked by the compiler alone
const { title: _, ...incomplete } = t;
// @ts-expect-error a key is missing
void (incomplete satisfies Messages);
// @ts-expect-error a text is where a function has to be
void ({ ...t, listed: "" } satisfies Messages);

describe.each(others)("the texts in %s", (_, other: Messages) => {
  const theirs = new Map(texts(other));

  it("are as many, and never empty where the English one is not", () => {
    expect([...theirs.keys()].sort()).toEqual(all.map(([path]) => path).sort());
    expect(all.filter(([path, text]) => text.trim() && !theirs.get(path)!.trim())).toEqual([]);
  });

  it("show as many values as the English ones", () => {
    const values = (text: string) => text.split("7").length;
    expect(all.filter(([path, text]) => values(text) !== values(theirs.get(path)!))).toEqual([]);
  });
});

describe("the language", () => {
  it("is the one chosen here, else the browser's, else English", () => {
    expect(preferred("zh", ["de-AT"])).toBe("zh");
    expect(preferred(null, ["tlh", "de-AT", "en"])).toBe("de");
    expect(preferred("xx", ["tlh"])).toBe("en");
    expect(preferred(null, [])).toBe("en");
  });
});

describe("the catalogue of effects", () => {
  const sources = import.meta.glob<string>("../../../station/**/effects/*.py", {
    query: "?raw",
    import: "default",
    eager: true,
  });
  const ids = Object.values(sources).flatMap((source) =>
    [...source.matchAll(/^ {4}id = "(\w+)"$/gm)].map(([, id]) => id),
  );
  const BESIDE = ["outliers", "reading_step", "unnamed"];

  it("has a display name for each effect, and no name without one", () => {
    expect(ids.length).toBeGreaterThan(10);
    expect(Object.keys(t.effects).toSorted()).toEqual([...new Set([...ids, ...BESIDE])].toSorted());
  });

  it("has a display name for each parameter", () => {
    const named = Object.values(sources).flatMap((source) =>
      [...source.matchAll(/(?:Quantity|scaled|amplitude_and_phase)\("(\w+)"/g)].map(([, id]) => id!),
    );
    expect(named.length).toBeGreaterThan(10);
    expect(named.filter((id) => !parameter(id).text)).toEqual([]);
  });
});

describe("outcomes and kinds of run", () => {
  it("of the message file are those of the service", () => {
    const { outcome } = openapi.components.schemas.CalibrationSummary.properties;
    const ids = outcome.anyOf.flatMap((one) => one.enum ?? []);
    expect(Object.keys(t.outcomes).toSorted()).toEqual(ids.toSorted());
  });
});
