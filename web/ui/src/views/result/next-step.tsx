/** The recommended next step: reason and button. */
import { apply, newKey, resume, rollBack, separate, start } from "../../api";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { Link } from "../../parts/link";
import { MotionWarning } from "../../parts/motion-warning";
import { OperatorField } from "../../parts/operator-field";
import { navigate, path } from "../../router";
import type { Calibration, Experiment, Plan } from "../../types";
import { chosenPlan, takeSerial } from "../station/start";
import { type Act, nextStep } from "./steps";

interface Props {
  result: Calibration;
  experiments?: readonly Experiment[] | undefined;
}

export function NextStep({ result, experiments }: Props) {
  const { why, act, more } = nextStep(result, experiments);
  // a view that is already shown is not a next step
  if (act?.do === "open" && act.to === path.value) return null;
  const { text, button = "" }: { text: string; button?: string } = t.result.next[why];
  return (
    <section class="panel wide next-step" aria-label={t.result.nextStep}>
      <h2>{t.result.nextStep}</h2>
      <p>
        {text} {more}
      </p>
      {act?.do === "open" && (
        <p class="actions">
          <Link class="button act" to={act.to}>
            {button}
          </Link>
        </p>
      )}
      {act?.do === "prepare" && (
        <p class="actions">
          <button type="button" class="act" onClick={() => prepare(result.robot_serial, act.plan)}>
            {button}
          </button>
        </p>
      )}
      {/* another step is another button: a press meant for one must never trigger the other */}
      {act && act.do !== "open" && act.do !== "prepare" && (
        <Confirmed key={why} label={button} act={act} result={result} />
      )}
    </section>
  );
}

type Moving = Exclude<Act, { do: "open" | "prepare" }>;

/** The start form with the known values; nothing moves before it is confirmed there. */
function prepare(robot: string, plan: Plan): void {
  takeSerial(robot);
  chosenPlan.value = plan;
  navigate("/");
}

function Confirmed({ label, act, result }: { label: string; act: Moving; result: Calibration }) {
  const idle = connected.value && !station.value?.run && operator.value.trim() !== "";
  return (
    <div class="writes">
      <OperatorField id="next-operator" />
      <ConfirmedButton
        prominent
        label={label}
        disabled={!idle}
        act={async () => {
          keepOperator();
          await carryOut(act, result);
        }}
      >
        <MotionWarning serial={result.robot_serial} then={t.result.consequences[act.do]} />
      </ConfirmedButton>
    </div>
  );
}

async function carryOut(act: Moving, result: Calibration): Promise<void> {
  const who = operator.value.trim();
  switch (act.do) {
    case "apply":
      await apply(result.id, who, newKey());
      return;
    case "roll_back":
      await rollBack(result.id, who);
      return;
    case "separate":
      navigate(`/result/${(await separate(result.id, who, newKey())).id}`);
      return;
    case "resume":
      navigate(`/result/${(await resume(result.id, who, newKey())).id}`);
      return;
    case "start": {
      const { robot_serial, work_order, accuracy } = result;
      const wanted = accuracy?.wanted_mm ?? null;
      const body = { robot_serial, plan: act.plan, operator: who, work_order, accuracy_mm: wanted };
      navigate(`/result/${(await start(body, newKey())).id}`);
    }
  }
}
