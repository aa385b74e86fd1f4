/** The zero offsets of a run in the drives, in one line. */
import { station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import type { ApplicationState, Calibration, Run } from "../../types";

type Drives = NonNullable<Calibration["application"]>;

const ALARMS = new Set<ApplicationState>(["partly", "in doubt"]);

export function DriveState({ result: { id, application } }: { result: Calibration }) {
  if (!application) return null;
  const run = station.value?.run;
  const writing = run?.of === id ? run : null;
  const alarm = !writing && ALARMS.has(application.state);
  return (
    <p role="status" class={alarm ? "now alarm act" : "now"}>
      {writing ? progress(writing) : statement(application)}
    </p>
  );
}

function progress({ walk, step, steps }: Run): string {
  return t.result.step(walk ? said(walk.title) : t.shared.waiting, t.shared.stepOf(step ?? 0, steps || "?"));
}

/** The zeros in the drives, and whether fresh readings agreed. */
export function statement({ state, text, verified }: Pick<Drives, "state" | "text" | "verified">): string {
  const shape = ALARMS.has(state) ? "▲" : verified ? "✓" : "○";
  const checked = state === "applied" ? [verified ? t.result.verified : t.result.notVerified] : [];
  return [shape, said(text), ...checked].join(" ");
}
