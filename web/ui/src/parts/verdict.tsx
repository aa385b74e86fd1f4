/** The end of a run in one line: shape, word, reason. Colour only if there is a problem. */
import { t } from "../messages";
import { reasonText } from "../reason";
import type { Outcome, State, Summary, Verdict } from "../types";

interface Look {
  shape: string;
  alarm: "" | "act" | "warn";
}

const STATES: Record<State, Look> = {
  queued: { shape: "○", alarm: "" },
  running: { shape: "▶", alarm: "" },
  waiting: { shape: "◆", alarm: "warn" },
  succeeded: { shape: "◆", alarm: "warn" },
  failed: { shape: "▲", alarm: "act" },
  aborted: { shape: "◆", alarm: "warn" },
  interrupted: { shape: "◆", alarm: "warn" },
};

const OUTCOMES: Record<Outcome, Look> = {
  good: { shape: "✓", alarm: "" },
  repair: { shape: "◆", alarm: "warn" },
  ambiguous: { shape: "◆", alarm: "warn" },
  unexplained: { shape: "▲", alarm: "act" },
  not_accurate_enough: { shape: "◆", alarm: "warn" },
  not_verified: { shape: "◆", alarm: "warn" },
  failed: { shape: "▲", alarm: "act" },
  aborted: { shape: "◆", alarm: "warn" },
  interrupted: { shape: "◆", alarm: "warn" },
};

type Ended = Pick<Summary, "state" | "verdict"> & Partial<Pick<Summary, "outcome">>;

export interface Worded extends Look {
  word: string;
  text: string;
  /** Verdict beside an outcome; empty if the word is the verdict already. */
  verdict: string;
  /** Whether the robot may be used as it is. */
  good: boolean;
}

/**
 * The outcome of the run if it has one, otherwise its verdict, otherwise its state; never better than any of
 * them.
 */
export function outcomeOf({ state, verdict, outcome }: Ended): Worded {
  if (state !== "succeeded") return worded(t.states[state], STATES[state]);
  if (outcome && outcome !== "good") {
    return worded(t.outcomes[outcome], OUTCOMES[outcome], verdict === "fail" ? verdict : null);
  }
  if (verdict === "pass" && outcome === "good") return worded(t.outcomes.good, OUTCOMES.good, verdict);
  // an attempt to write zeros has only a verdict; for a run, a pass alone does not state what to repair
  if (verdict === "pass" && outcome === undefined) return worded(t.verdicts.pass, OUTCOMES.good);
  if (verdict === "fail") return worded(t.verdicts.fail, STATES.failed);
  return worded({ name: t.shared.noVerdict, text: t.states.succeeded.text }, STATES.succeeded);
}

const upper = (name: string) => name.toUpperCase();
const worded = (
  entry: { name: string; text: string },
  look: Look,
  beside: Verdict | null = null,
): Worded => ({
  ...look,
  word: upper(entry.name),
  text: entry.text,
  verdict: beside ? upper(t.verdicts[beside].name) : "",
  good: entry === t.outcomes.good,
});

export function Badge({ run }: { run: Ended }) {
  const { word, shape, alarm, verdict } = outcomeOf(run);
  return (
    <span class="badges">
      <strong class={`badge ${alarm && `alarm ${alarm}`}`}>
        <span aria-hidden="true">{shape}</span> {word}
      </strong>{" "}
      {verdict && <span class="beside">{t.shared.verdict(verdict)}</span>}
    </span>
  );
}

export function VerdictLine({ run }: { run: Summary }) {
  const progress = run.state === "running" ? t.shared.stepOf(run.step ?? 0, run.steps ?? "?") : "";
  return (
    <p class="verdict">
      <Badge run={run} /> <span class="serial">{run.robot_serial}</span>
      <span>{reasonText(run) ?? progress}</span>
    </p>
  );
}
