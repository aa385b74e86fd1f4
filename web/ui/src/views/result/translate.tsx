/**
 * Positions taught under the zeros before this run, as the same physical positions under its zeros, and back.
 */
import { useSignal } from "@preact/signals";
import { translate } from "../../api";
import { fixed } from "../../format";
import { t } from "../../messages";
import { saveFile } from "../../parts/save-file";
import type { TranslatedList } from "../../types";
import { isFile, taughtOf, translatedCsv } from "./taught";

export function Translate({ id }: { id: number }) {
  const text = useSignal("");
  const back = useSignal(false);
  const trouble = useSignal<string | null>(null);
  const translated = useSignal<TranslatedList | null>(null);
  const m = t.result.translate;
  const submit = async (event: SubmitEvent) => {
    event.preventDefault();
    const file = isFile(text.value);
    const { positions, wrong } = file ? { positions: [], wrong: null } : taughtOf(text.value);
    trouble.value = wrong === null ? (positions.length === 0 && !file ? m.none : null) : m.wrong(wrong);
    translated.value = null;
    if (trouble.value) return;
    try {
      translated.value = await translate(id, file ? { text: text.value } : { positions }, back.value);
    } catch (error) {
      trouble.value = (error as Error).message;
    }
  };
  return (
    <form class="translate" onSubmit={(event) => void submit(event)}>
      <p class="note">{m.note}</p>
      <label for="taught">{m.positions}</label>
      <textarea
        id="taught"
        rows={4}
        spellcheck={false}
        aria-describedby="taught-trouble"
        aria-invalid={trouble.value !== null}
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
        }}
      />
      <label class="check">
        <input
          type="checkbox"
          checked={back.value}
          onChange={(event) => {
            back.value = event.currentTarget.checked;
          }}
        />
        {m.back}
      </label>
      <p id="taught-trouble" class="trouble" role="alert">
        {trouble.value && `▲ ${trouble.value}`}
      </p>
      <button type="submit">{m.button}</button>
      {translated.value && <Positions id={id} translated={translated.value} />}
    </form>
  );
}

function Positions({
  id,
  translated: { items: positions, program },
}: {
  id: number;
  translated: TranslatedList;
}) {
  const m = t.result.translate;
  return (
    <>
      <table>
        <thead>
          <tr>
            <th scope="col" class="text">
              {t.station.position}
            </th>
            <th scope="col">θ₁, °</th>
            <th scope="col">θ₂, °</th>
            <th scope="col">{m.uncertainty}</th>
            <th scope="col" class="text">
              {m.limits}
            </th>
          </tr>
        </thead>
        <tbody>
          {positions.map(({ position, theta1_deg, theta2_deg, u95_mm, within_limits }, k) => (
            <tr key={k}>
              <th scope="row" class="text serial">
                {position}
              </th>
              <td class="main">{fixed(theta1_deg, 4)}</td>
              <td class="main">{fixed(theta2_deg, 4)}</td>
              <td>{fixed(u95_mm, 3)}</td>
              <td class="text">{within_limits ? m.within : m.near}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <button type="button" onClick={() => saveFile(m.file(id), "text/csv", translatedCsv(positions))}>
        {m.save}
      </button>
      {program && (
        <button type="button" onClick={() => saveFile(m.programFile(id), "text/plain", program)}>
          {m.saveProgram}
        </button>
      )}
    </>
  );
}
