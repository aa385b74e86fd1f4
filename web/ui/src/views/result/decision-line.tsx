/** The decision of the result, in large type: one word with its shape, and the reason. */
import { significant } from "../../format";
import { t } from "../../messages";
import type { Calibration } from "../../types";
import { decisionOf } from "./decision";

export function DecisionLine({ result }: { result: Calibration }) {
  const { look, sentence } = decisionOf(result);
  return (
    <p class="verdict decision">
      <strong class={look.alarm ? `badge alarm ${look.alarm}` : "badge"}>
        <span aria-hidden="true">{look.shape}</span> {look.word}:
      </strong>{" "}
      <span class="why">{sentence}</span>
    </p>
  );
}

/** The applied limit, or that there was none. */
export function WantedLine({ result: { accuracy, ended_at, kind } }: { result: Calibration }) {
  if (!ended_at || kind === "retract" || kind === "check") return null;
  const wanted = accuracy?.wanted_mm;
  return (
    <p class="note">{wanted == null ? t.result.wantedNone : t.result.wantedIs(significant(wanted, 6))}</p>
  );
}
