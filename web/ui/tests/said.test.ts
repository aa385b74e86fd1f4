import { beforeEach, describe, expect, it, vi } from "vitest";
import { sentences as de } from "../src/messages/de-sentences";
import { sentences as zh } from "../src/messages/zh-sentences";

const places = (text: string) => text.split("{}").length;

/** As a page in German has it. */
async function inGerman() {
  vi.resetModules();
  localStorage.setItem("language", "de");
  return (await import("../src/messages/said")).said;
}

describe("what the station says in English only", () => {
  beforeEach(() => localStorage.clear());

  it("has the same sentences and numbers in each language", () => {
    expect(Object.keys(zh)).toEqual(Object.keys(de));
    for (const texts of [de, zh]) {
      for (const [english, text] of Object.entries(texts))
        expect(places(text), english).toBe(places(english));
    }
  });

  it("is said in the page's language, with its numbers", async () => {
    const said = await inGerman();
    expect(said("answers: 5 replies, 0.31 ms as a rule, 4.40 ms the slowest")).toBe(
      "antwortet: 5 Antworten, in der Regel nach 0,31 ms, die langsamste nach 4,40 ms",
    );
  });

  it("is said sentence by sentence, and what is not known in English", async () => {
    const said = await inGerman();
    expect(said("The drives hold these zero offsets. Call Ada.")).toBe(
      "Die Antriebe haben diese Nullpunkte. Call Ada.",
    );
    expect(said("constructor")).toBe("constructor");
  });
});
