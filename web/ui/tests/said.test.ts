import { beforeEach, describe, expect, it, vi } from "vitest";
import { de as german } from "../src/messages/de";
import { zh as chinese } from "../src/messages/zh";

const { sentences: de } = german;
const { sentences: zh } = chinese;
/** Names that the English text has and the other does not need are left out. */
const PLACE = /\{\w*\}/g;
const places = (text: string) => new Set(text.match(PLACE)).size;

/** As a page in that language has it. */
async function inLanguage(language: "en" | "de" | "zh") {
  vi.resetModules();
  localStorage.setItem("language", language);
  return (await import("../src/messages/said")).said;
}

describe("what the station says in English only", () => {
  beforeEach(() => localStorage.clear());

  it("has the same sentences and numbers in each language", () => {
    expect(Object.keys(zh)).toEqual(Object.keys(de));
    for (const texts of [de, zh]) {
      for (const [english, text] of Object.entries(texts))
        for (const [place] of text.matchAll(PLACE)) expect(english).toContain(place);
    }
    // an address, a unit number or the names of sign-in ways that a sentence can do without
    const fewer = Object.entries(zh).filter(([english, text]) => places(text) < places(english));
    expect(fewer.filter(([english]) => !english.startsWith("drive {unit}: "))).toEqual([]);
  });

  it("is said in the page's language, with its numbers", async () => {
    const said = await inLanguage("de");
    expect(said("answers: 5 replies, 0.31 ms as a rule, 4.40 ms the slowest")).toBe(
      "antwortet: 5 Antworten, in der Regel nach 0,31 ms, die langsamste nach 4,40 ms",
    );
  });

  it("is said sentence by sentence, and what is not known in English", async () => {
    const said = await inLanguage("de");
    expect(said("The drives hold these zero offsets. Call Ada.")).toBe(
      "Die Antriebe haben diese Nullpunkte. Call Ada.",
    );
    expect(said("constructor")).toBe("constructor");
    expect(said("The linear one at the bench")).toBe("The linear one at the bench");
  });

  it("has names, devices and sentences within it in the page's language as well", async () => {
    const said = await inLanguage("zh");
    expect(said("Not ready to start. All devices answer: no answer: linear scale.")).toBe(
      "尚不能启动。所有设备均有应答：没有应答：光栅尺。",
    );
    const silent = (unit: number) =>
      `Drive ${unit} does not answer on 127.0.0.1:4001; check cable, power and address.`;
    expect(said(`${silent(1)} ${silent(2)}`)).toBe(
      "驱动器 1 在 127.0.0.1:4001 上没有应答；请检查电缆、电源和地址。" +
        "驱动器 2 在 127.0.0.1:4001 上没有应答；请检查电缆、电源和地址。",
    );
    expect(said("drive 2: 602Ch position, pulses = -1234")).toBe("−1234（寄存器 602Ch）");
  });

  it("has one unit for an angle, also in English", async () => {
    const said = await inLanguage("en");
    expect(said("The drive says 12.500 deg.")).toBe("The drive says 12.500°.");
  });
});
