/** From any result to the measurement sequence that finds the missing effect: press, then confirm. */
import { newKey, start } from "../../api";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { MotionWarning } from "../../parts/motion-warning";
import { OperatorField } from "../../parts/operator-field";
import { reasonText } from "../../reason";
import { navigate } from "../../router";
import type { Calibration } from "../../types";

export function FindCause({ result }: { result: Calibration }) {
  const { robot_serial, work_order, lack_of_fit, lack_of_fit_reason } = result;
  // that sentence is about the solver; its meaning is stated below
  const inside = result.reason_code === "not_identified";
  const lack = reasonText({
    reason: lack_of_fit,
    reason_code: lack_of_fit_reason?.code ?? null,
    reason_params: lack_of_fit_reason?.params ?? {},
  });
  const idle = connected.value && !station.value?.run && operator.value.trim() !== "";
  const find = async () => {
    keepOperator();
    const who = operator.value.trim();
    const body = { robot_serial, plan: "diagnostic" as const, operator: who, work_order, metadata: {} };
    const run = await start(body, newKey());
    navigate(`/result/${run.id}`);
  };
  return (
    <div class="find-cause">
      {lack_of_fit !== null && (
        <>
          <p>
            <strong class="alarm warn">{t.result.misfit}</strong>
          </p>
          {!inside && lack_of_fit !== result.reason && <p>{lack}</p>}
          <p>{result.zero_offsets.length ? t.result.misfitOffsets : t.result.misfitNone}</p>
        </>
      )}
      <p>{t.result.findCauseNote}</p>
      <div class="writes">
        <OperatorField id="cause-operator" />
        <ConfirmedButton label={t.result.findCause} disabled={!idle} act={find}>
          <MotionWarning serial={robot_serial} then={t.result.wholeWorkspace} />
        </ConfirmedButton>
      </div>
    </div>
  );
}
