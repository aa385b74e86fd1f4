/** Use of a diagnosis: download the model, or compute commands for targets under it. */
import { useSignal } from "@preact/signals";
import { solve } from "../../api";
import { fixed } from "../../format";
import { t } from "../../messages";
import { readable } from "../../names";
import { saveFile } from "../../parts/save-file";
import { told } from "../../phrase";
import type { Solution, Target } from "../../types";
import { commandsCsv, targetsOf } from "./targets";

interface Solved {
  targets: Target[];
  solution: Solution;
}

export function UseResult({ id }: { id: number }) {
  const text = useSignal("");
  const trouble = useSignal<string | null>(null);
  const solved = useSignal<Solved | null>(null);
  const compute = async (event: SubmitEvent) => {
    event.preventDefault();
    const { targets, wrong } = targetsOf(text.value);
    trouble.value =
      wrong === null ? (targets.length === 0 ? t.diagnosis.noTarget : null) : t.diagnosis.wrongTarget(wrong);
    if (trouble.value) return;
    try {
      solved.value = { targets, solution: await solve(id, targets) };
    } catch (error) {
      trouble.value = readable((error as Error).message);
      solved.value = null;
    }
  };
  return (
    <section class="panel wide use-result" aria-label={t.diagnosis.use}>
      <h2>{t.diagnosis.use}</h2>
      <p class="actions">
        <a class="button" href={`/api/v1/calibrations/${id}/diagnosis`} download={t.diagnosis.modelName(id)}>
          {t.diagnosis.takeModel}
        </a>
      </p>
      <p class="note">{t.diagnosis.takeModelNote}</p>
      <form onSubmit={(event) => void compute(event)}>
        <label for="targets">{t.diagnosis.targets}</label>
        <textarea
          id="targets"
          rows={4}
          spellcheck={false}
          aria-describedby="targets-trouble"
          aria-invalid={trouble.value !== null}
          value={text.value}
          onInput={(event) => {
            text.value = event.currentTarget.value;
          }}
        />
        <p id="targets-trouble" class="trouble" role="alert">
          {trouble.value && `▲ ${trouble.value}`}
        </p>
        <button type="submit">{t.diagnosis.compute}</button>
      </form>
      {solved.value && <Commands id={id} {...solved.value} />}
    </section>
  );
}

function Commands({ id, targets, solution }: Solved & { id: number }) {
  const { commands, range, range_said, confirmed } = solution;
  return (
    <>
      {confirmed === false && <p class="alarm warn">{t.diagnosis.refuted}</p>}
      <table>
        <thead>
          <tr>
            <th scope="col">{t.station.xAxis}</th>
            <th scope="col">{t.diagnosis.yAxis}</th>
            <th scope="col">{t.diagnosis.command(1)}</th>
            <th scope="col">{t.diagnosis.command(2)}</th>
          </tr>
        </thead>
        <tbody>
          {commands.map(({ theta1_deg, theta2_deg }, k) => (
            <tr key={k}>
              <td>{fixed(targets[k]?.x_mm, 3)}</td>
              <td>{fixed(targets[k]?.y_mm, 3)}</td>
              <td class="main">{fixed(theta1_deg, 4)}</td>
              <td class="main">{fixed(theta2_deg, 4)}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="note">{told({ text: range, said: range_said })}</p>
      <button
        type="button"
        onClick={() => saveFile(t.diagnosis.commandsName(id), "text/csv", commandsCsv(targets, solution))}
      >
        {t.diagnosis.saveCommands}
      </button>
    </>
  );
}
