/** The training desk: the error of the emulated machine beside the station's finding. */
import { useSignal } from "@preact/signals";
import { newKey, start } from "../../api";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { OperatorField } from "../../parts/operator-field";
import type { Exercise, Training } from "../../types";
import { ActionButton, Pending } from "./action";
import { Needs } from "./allowed";
import { draw, repair, reveal, training } from "./calls";
import { ChooseExercise } from "./choose-exercise";
import { ExerciseList, Saying, wrongWith } from "./exercises";

/** Exercises give no information about a robot of the plant. */
const SERIAL = "TRAINING";

export function TrainingPart() {
  const done = useSignal(0);
  // requested again when a run starts or ends
  const latest = `${done.value} ${station.value?.run?.id} ${station.value?.last?.id}`;
  const { value: desk, trouble } = useLoaded(latest, training).value;
  const after = async (asked: Promise<Training>) => {
    await asked;
    done.value += 1;
  };
  return (
    <>
      <section class="panel part" aria-labelledby="training-title">
        <h2 id="training-title">{t.training.title}</h2>
        <p>{t.training.note}</p>
        {!desk && <Pending trouble={trouble} />}
        {desk && <Current exercise={desk.current} after={after} />}
      </section>
      {desk && (
        <section class="panel part" aria-labelledby="choose-title">
          <h2 id="choose-title">{t.training.choose}</h2>
          <Needs permission="maintain">
            <ActionButton prominent act={() => after(draw())} disabled={Boolean(station.value?.run)}>
              {t.training.surprise}
            </ActionButton>
            <p class="note">{t.training.surpriseNote}</p>
            <ChooseExercise challenges={desk.challenges} after={after} />
          </Needs>
        </section>
      )}
      {desk && <ExerciseList exercises={desk.done} />}
    </>
  );
}

function Current({
  exercise,
  after,
}: {
  exercise: Exercise | null;
  after: (asked: Promise<Training>) => Promise<void>;
}) {
  const run = station.value?.run;
  return (
    <>
      {exercise ? (
        <dl class="pairs">
          <div>
            <dt>{t.training.current(exercise.n)}</dt>
            <dd>{exercise.revealed ? wrongWith(exercise) : t.training.unseen}</dd>
          </div>
          {exercise.said && <Saying exercise={exercise} />}
        </dl>
      ) : (
        <p class="main">{t.training.idle}</p>
      )}
      <p role="status">
        {run && (
          <Link to="/" class="button">
            {t.training.running(run.id)}
          </Link>
        )}
      </p>
      <div class="fields">
        <OperatorField id="training-operator" />
      </div>
      <Diagnose />
      <Needs permission="maintain">
        <div class="fields">
          <ActionButton disabled={!exercise || exercise.revealed} act={() => after(reveal())}>
            {t.training.reveal}
          </ActionButton>
          <ActionButton act={() => after(repair())}>{t.training.repaired}</ActionButton>
        </div>
      </Needs>
    </>
  );
}

function Diagnose() {
  const ready = connected.value && !station.value?.run && operator.value.trim() !== "";
  const act = () => {
    keepOperator();
    const body = {
      robot_serial: SERIAL,
      plan: "diagnostic" as const,
      operator: operator.value.trim(),
      references: [],
    };
    return start(body, newKey());
  };
  return (
    <ConfirmedButton label={t.training.run} disabled={!ready} act={act} prominent>
      {t.training.runText}
    </ConfirmedButton>
  );
}
