/** Exercises: the error, the station's finding, and the score. */
import { local, percent } from "../../format";
import { t } from "../../messages";
import { effectName, readable, unitName } from "../../names";
import { Link } from "../../parts/link";
import type { Exercise } from "../../types";
import { Table } from "./table";

const ALARM: Record<NonNullable<Exercise["score"]>, string> = {
  found: "",
  withstood: "",
  partly: "alarm warn",
  noticed: "alarm warn",
  wrong: "alarm act",
  missed: "alarm act",
};

export const challengeName = (kind: string) =>
  t.training.kinds[kind]?.name ?? effectName({ effect: kind, joint: null });

/** "Backlash, joint 2, 0.05 °". */
export function wrongWith({ challenge, joint, size }: Exercise): string {
  if (challenge === null) return t.training.notRevealed;
  const name = challengeName(challenge.kind);
  const at = joint === null ? name : t.training.at(name, joint);
  return size === null ? at : t.training.sized(at, `${local(String(size))} ${unitName(challenge.unit)}`);
}

/** The finding of the run, in words. */
export function inWords({ said }: Exercise): string {
  if (said === null) return "";
  if (said.diagnosis === null) return readable(said.reason ?? t.states[said.state].name);
  const causes = said.causes.map((cause) =>
    cause.probability === null ? effectName(cause) : `${effectName(cause)} (${percent(cause.probability)})`,
  );
  return `${t.verdicts[said.diagnosis as keyof typeof t.verdicts].name}: ${causes.join(", ") || t.training.noCause}`;
}

export function Saying({ exercise }: { exercise: Exercise }) {
  const { said, score } = exercise;
  if (said === null) return null;
  return (
    <>
      <div>
        <dt>{t.training.said}</dt>
        <dd>
          {inWords(exercise)}{" "}
          <Link to={said.diagnosis ? `/diagnosis/${said.run}` : `/result/${said.run}`} class="cell">
            {t.training.diagnosis(said.run)}
          </Link>
        </dd>
      </div>
      {score && (
        <div>
          <dt>{t.training.score}</dt>
          <dd>
            <strong class={ALARM[score]}>{t.training.scores[score].name}</strong>{" "}
            <small>{t.training.scores[score].text}</small>
          </dd>
        </div>
      )}
    </>
  );
}

export function ExerciseList({ exercises }: { exercises: Exercise[] }) {
  const m = t.training;
  return (
    <section class="panel part" aria-labelledby="exercises-title">
      <h2 id="exercises-title">{m.list}</h2>
      {exercises.length === 0 ? (
        <p class="empty">{m.noExercises}</p>
      ) : (
        <Table label={m.list} head={[m.exercise, m.chosen, m.said, m.score]}>
          {exercises.map((exercise) => (
            <tr key={exercise.n}>
              <td class="text">{exercise.n}</td>
              <td class="text wrapped">
                {wrongWith(exercise)} <small>({exercise.unseen ? m.drawn : m.picked})</small>
              </td>
              <td class="text wrapped">{inWords(exercise) || "–"}</td>
              <td class="text">
                {exercise.score ? (
                  <strong class={ALARM[exercise.score]}>{m.scores[exercise.score].name}</strong>
                ) : (
                  "–"
                )}
              </td>
            </tr>
          ))}
        </Table>
      )}
    </section>
  );
}
