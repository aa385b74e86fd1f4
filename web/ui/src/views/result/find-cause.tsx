/** From any result to the walk that looks for what the model lacks: press, then confirm. */
import { type Calibration, newKey, start } from "../../api";
import { connected, station } from "../../live";
import { keepOperator, operator } from "../../operator";
import { navigate } from "../../router";
import { ConfirmedButton } from "../../parts/confirm";
import { OperatorField } from "../../parts/operator-field";

export function FindCause({ result: { robot_serial, work_order, lack_of_fit, zero_offsets } }: { result: Calibration }) {
  const idle = connected.value && !station.value?.run && operator.value.trim() !== "";
  const walk = async () => {
    keepOperator();
    const body = { robot_serial, plan: "diagnostic" as const, operator: operator.value.trim(), work_order, metadata: {} };
    const run = await start(body, newKey());
    navigate(`/result/${run.id}`);
  };
  return (
    <section class="panel wide find-cause" aria-label="Cause">
      {lack_of_fit === null ? (
        <h2>Does the model lack something?</h2>
      ) : (
        <>
          <h2>
            <strong class="alarm warn">◆ The model does not account for these readings</strong>
          </h2>
          <p>
            {zero_offsets?.length
              ? `Something is missing from it, and the zero offsets may be wrong by more than they say: ${lack_of_fit}.`
              : "No machine within the tolerances gives them: something is missing from the model, or the robot file is of another machine."}
          </p>
        </>
      )}
      <p>
        A walk of 120 readings there and back shows what the residual depends on and names its cause; 40 fresh readings
        then judge it.
      </p>
      <div class="writes">
        <OperatorField id="cause-operator" />
        <ConfirmedButton label="Find the cause" prominent={lack_of_fit !== null} disabled={!idle} act={walk}>
          <strong>Robot {robot_serial} will move</strong> over its whole workspace. Nobody within its reach?
        </ConfirmedButton>
      </div>
    </section>
  );
}
