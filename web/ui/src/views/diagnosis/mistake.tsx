/** A wrong label in the data, without which the diagnosis continued. */
import { t } from "../../messages";
import { told } from "../../phrase";
import type { Diagnosis } from "../../types";

export function MistakeInData({ found: { mistake } }: { found: Diagnosis }) {
  if (!mistake) return null;
  const rows = mistake.rows.length === 1 ? t.diagnosis.mistakeRow : t.diagnosis.mistakeRows;
  return (
    <section class="panel wide" aria-label={t.diagnosis.mistake}>
      <h2>
        <strong class="alarm warn">{t.diagnosis.mistakeTitle}</strong>
      </h2>
      <p>{told(mistake)}</p>
      {mistake.rows.length > 0 && <p class="note">{rows(t.listed(stretches(mistake.rows)))}</p>}
    </section>
  );
}

/** 3, 4, 5, 9 as "3 to 5", "9"; ids that are words follow unchanged. */
export function stretches(rows: (number | string)[]): string[] {
  const found: [number, number][] = [];
  for (const row of rows.filter((id) => typeof id === "number").toSorted((a, b) => a - b)) {
    const last = found.at(-1);
    if (last && row - last[1] <= 1) last[1] = row;
    else found.push([row, row]);
  }
  const numbered = found.map(([first, last]) =>
    first === last ? String(first) : t.diagnosis.rowsTo(first, last),
  );
  return [...numbered, ...rows.filter((id) => typeof id === "string")];
}
