/** The decision of a result: one word, and its sentence. Never better than any part of the record. */
import { fixed, quantity } from "../../format";
import { t } from "../../messages";
import { capital, effectName, inSentence, shown } from "../../names";
import { outcomeOf, type Worded } from "../../parts/verdict";
import { paramsInWords, reasonText } from "../../reason";
import type { Calibration, Finding } from "../../types";

export interface Decision {
  look: Worded;
  sentence: string;
}

const DIGITS = 3;
/** More digits, if the bound and the limit look the same otherwise. */
const MORE_DIGITS = 5;

export function decisionOf(result: Calibration): Decision {
  const look = outcomeOf(missed(result) ? { ...result, outcome: "not_accurate_enough" } : result);
  return { look, sentence: sentenceOf(result, look) };
}

/**
 * Whether the bound exceeds a limit: the bound is compared, not the estimate; without a bound, no limit is
 * met.
 */
function missed({ state, outcome, accuracy }: Calibration): boolean {
  const wanted = accuracy?.wanted_mm;
  if (state !== "succeeded" || outcome !== "good" || wanted == null) return false;
  return !(accuracy!.bound_95_mm !== null && accuracy!.bound_95_mm <= wanted);
}

/** Numbers of a run that was not accepted are not valid. */
export const isValid = (result: Calibration) =>
  result.state === "succeeded" && result.verdict === "pass" && result.outcome === "good" && !missed(result);

function sentenceOf(result: Calibration, look: Worded): string {
  if (result.state === "queued" || result.state === "running" || result.state === "waiting") {
    return t.shared.stepOf(result.step ?? 0, result.steps ?? "?");
  }
  if (result.reason_code === "not_identified") return t.result.decision.notIdentified;
  const byOutcome = result.state === "succeeded" ? byNumbers(result) : null;
  return byOutcome ?? withoutWord(reasonText(result) ?? look.text, look.word);
}

function byNumbers(result: Calibration): string | null {
  const bound = result.accuracy?.bound_95_mm;
  switch (result.outcome) {
    case "good":
    case "not_accurate_enough":
      return bound == null ? null : promised(bound, result.accuracy!.wanted_mm);
    case "repair":
      return result.findings.length === 0 ? null : t.both(result.findings.map(sized));
    case "ambiguous":
      return undecided(result);
    default:
      return null;
  }
}

function promised(bound: number, wanted: number | null): string {
  if (wanted === null) return t.result.decision.unlimited(fixed(bound, DIGITS));
  const same = fixed(bound, DIGITS) === fixed(wanted, DIGITS) && bound !== wanted;
  const digits = same ? MORE_DIGITS : DIGITS;
  return t.result.decision.limited(fixed(bound, digits), fixed(wanted, digits));
}

/** An effect and its size, with its expanded uncertainty. */
function sized(finding: Finding, rank: number): string {
  const name = rank === 0 ? effectName(finding) : inSentence(effectName(finding));
  const [first] = finding.parameters.map(shown);
  return first ? t.result.decision.sized(name, quantity(first.value, first.sd, first.unit)) : name;
}

function undecided({ reason_code, reason_params }: Calibration): string | null {
  const { causes, others, probability_percent: percent } = paramsInWords(reason_params);
  if (reason_code !== "ambiguous" || typeof percent !== "number" || others === undefined) return null;
  return capital(t.result.decision.undecided(String(causes), fixed(percent, 0), String(others)));
}

/** Without the word that precedes it already. */
function withoutWord(text: string, word: string): string {
  const [, first = "", rest = ""] = /^(.*?)(?:: |：)(.*)$/s.exec(text) ?? [];
  return first.toUpperCase() === word ? capital(rest) : text;
}
