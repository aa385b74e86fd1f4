/** The verdict in one line: word, shape, reason.  Colour only where something is wrong. */
import { t } from "../messages";
import type { State, Summary } from "../types";

interface Look {
  shape: string;
  alarm: "" | "act" | "warn";
}

const LOOKS: Record<State, Look> = {
  queued: { shape: "○", alarm: "" },
  running: { shape: "▶", alarm: "" },
  succeeded: { shape: "◆", alarm: "warn" },
  failed: { shape: "▲", alarm: "act" },
  aborted: { shape: "◆", alarm: "warn" },
  interrupted: { shape: "◆", alarm: "warn" },
};

type Ended = Pick<Summary, "state" | "verdict">;

/** The verdict where the run has come to one, else its state. */
export function verdictOf({ state, verdict }: Ended): Look & { word: string; explanation: string } {
  const { badge, explanation } = t.states[state];
  const looks = { ...LOOKS[state], word: badge, explanation };
  if (state !== "succeeded" && state !== "failed") return looks;
  if (verdict === "pass" && state === "succeeded") return { ...worded("pass"), shape: "✓", alarm: "" };
  return verdict === "fail" ? { ...worded("fail"), shape: "▲", alarm: "act" } : looks;
}

function worded(verdict: "pass" | "fail") {
  const { badge, explanation } = t.verdicts[verdict];
  return { word: badge, explanation };
}

export function Badge({ run }: { run: Ended }) {
  const { word, shape, alarm } = verdictOf(run);
  return (
    <strong class={`badge ${alarm && `alarm ${alarm}`}`}>
      <span aria-hidden="true">{shape}</span> {word}
    </strong>
  );
}

export function VerdictLine({ run }: { run: Summary }) {
  const progress = run.state === "running" ? t.shared.stepOf(run.step ?? 0, run.steps ?? "?") : "";
  return (
    <p class="verdict">
      <Badge run={run} /> <span class="serial">{run.robot_serial}</span>
      <span>{run.reason ?? progress}</span>
    </p>
  );
}
