/** The verdict in one line: word, shape, reason.  Colour only where something is wrong. */
import type { State, Summary } from "../api";

const WORDS: Record<State, { word: string; shape: string; alarm: "" | "act" | "warn" }> = {
  queued: { word: "WAITING", shape: "○", alarm: "" },
  running: { word: "RUNNING", shape: "▶", alarm: "" },
  succeeded: { word: "NO VERDICT", shape: "◆", alarm: "warn" },
  failed: { word: "FAILED", shape: "▲", alarm: "act" },
  aborted: { word: "ABORTED", shape: "◆", alarm: "warn" },
  interrupted: { word: "INTERRUPTED", shape: "◆", alarm: "warn" },
};

export function verdictOf(run: Pick<Summary, "state" | "verdict">) {
  if (run.state !== "succeeded" && run.state !== "failed") return WORDS[run.state];
  if (run.verdict === "pass" && run.state === "succeeded") return { word: "PASS", shape: "✓", alarm: "" };
  if (run.verdict === "fail") return { word: "FAIL", shape: "▲", alarm: "act" };
  return WORDS[run.state];
}

export function Badge({ run }: { run: Pick<Summary, "state" | "verdict"> }) {
  const { word, shape, alarm } = verdictOf(run);
  return (
    <strong class={`badge ${alarm && `alarm ${alarm}`}`}>
      <span aria-hidden="true">{shape}</span> {word}
    </strong>
  );
}

export function VerdictLine({ run }: { run: Summary }) {
  return (
    <p class="verdict">
      <Badge run={run} /> <span class="serial">{run.robot_serial}</span>
      <span>{run.reason ?? (run.state === "running" ? `step ${run.step} of ${run.steps}` : "")}</span>
    </p>
  );
}
