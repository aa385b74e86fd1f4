import { beforeEach, describe, expect, it, vi } from "vitest";
import type { Phrase } from "../src/types";
import { finding } from "./samples";

/** The module as a page in that language has it, with its phrases. */
async function inLanguage(language: "en" | "de" | "zh") {
  vi.resetModules();
  localStorage.setItem("language", language);
  await (await import("../src/messages/phrases")).loadPhrases();
  return import("../src/phrase");
}

const phrase = (code: string, params: Phrase["params"] = {}): Phrase => ({ code, params });

/** A gain of a joint that a wrong ratio in the robot file explains as well. */
const REMEDY = phrase("sentences", {
  first: phrase("sentences", { first: phrase("transmission_gain_remedy"), second: phrase("check_ratio") }),
  second: phrase("ratio_or_gear", {
    joints: [phrase("joint", { number: 1 })],
    percent: 0.25,
    ratio: 50,
    better: 50.125,
  }),
});

describe("a text with a code", () => {
  beforeEach(() => localStorage.clear());

  it("is in the page's language, the remedy of a wrong entry with it", async () => {
    const { told } = await inLanguage("de");
    expect(told({ text: finding().remedy, said: REMEDY })).toBe(
      "Berichtigen Sie die Übersetzung oder die Impulse je Umdrehung im Antrieb. " +
        "Dasselbe zeigt sich, wo [joints] ratio oder counts_per_rev falsch ist: Prüfen Sie beide. " +
        "Die Winkel von Gelenk 1 sind um +0,25 % ihres Wegs falsch: Prüfen Sie [joints] ratio " +
        "(50; 50,125 würde passen) und counts_per_rev, oder das Getriebe selbst.",
    );
  });

  it("of an older version, or unknown to the page, is its English sentence", async () => {
    const { told } = await inLanguage("de");
    const text = "gear_cyclic of joint 1 has no code.";
    expect(told({ text: "adjust the reducer.", said: null })).toBe("Adjust the reducer.");
    expect(told({ text: "As the station says it.", said: phrase("brand_new") })).toBe(
      "As the station says it.",
    );
    expect(told({ text, said: phrase("share", { percent: 3 }) })).toBe(
      "Getriebewelligkeit von Gelenk 1 has no code.",
    );
  });

  it("has a capital if it is a whole sentence", async () => {
    const { phraseText, told } = await inLanguage("en");
    expect(phraseText(phrase("typical"))).toBe("typical of what was searched");
    expect(told({ text: "", said: phrase("typical") })).toBe("Typical of what was searched");
    expect(phraseText(phrase("fresh_agree_only", { what: "a", action: "b" }))).toMatch(/^The fresh/);
    expect((await inLanguage("zh")).phraseText(phrase("residual_time"))).toBe("残差随时间变化。");
  });

  it("is as it is in the middle of a sentence", async () => {
    const { told, toldInside } = await inLanguage("de");
    const ended = { text: "the plan has ended", said: phrase("plan_ended") };
    expect([toldInside(ended), told(ended)]).toEqual(["der Plan ist zu Ende", "Der Plan ist zu Ende"]);
    expect(toldInside({ ...ended, said: null })).toBe("the plan has ended");
  });

  it("has display names for identifiers within it", async () => {
    const { phraseText } = await inLanguage("de");
    const tied = phrase("looks_like", { parameter: "dtheta1", looks_like: "rMx, rMy" });
    expect(phraseText(tied)).toBe(
      "Nullpunktabweichung von Gelenk 1 (sieht aus wie Anbaufehler der Messeinrichtung, seitlich, " +
        "Anbaufehler der Messeinrichtung, in der Höhe)",
    );
    expect(phraseText(phrase("measure_mounting_or_plan", { plan: "full" }))).toMatch(/Plan Vollständig$/);
    expect(phraseText(phrase("still_depends", { depends_on: "theta2" }))).toMatch(
      /ab von: Winkel von Gelenk 2$/,
    );
    const causes = "backlash of joint 1 and unnamed error of joint 2";
    expect(phraseText(phrase("share", { causes, percent: 12.4 }))).toBe(
      "Getriebespiel von Gelenk 1 und unbenannter Fehler von Gelenk 2 (12 %)",
    );
  });
});
