/**
 * The residual before and after, ordered by its possible causes: first by the quantity that shows the cause.
 *
 * Ordering and zoom are in the address. A reading is selected by tap, or with the arrow keys.
 */
import { useSignal } from "@preact/signals";
import { micrometres, signedMicrometres } from "../../format";
import { t } from "../../messages";
import { labelsInSentence } from "../../names";
import { setQuery } from "../../parts/set-query";
import { query } from "../../router";
import type { Diagnosis, ResidualList, ResidualRow } from "../../types";
import { causeOrdering } from "./cause-ordering";
import { OrderingChart } from "./ordering-chart";
import { inOrder, medianLimit, type Ordering, orderingsOf, POSITION, type Series } from "./orderings";
import { readSpan, type Span, showing, writeSpan, zoomedIn, zoomedOut } from "./zoom";

type Residuals = Pick<ResidualList, "effects" | "items">;

interface Props {
  id: number;
  found: Diagnosis;
  residuals: Residuals;
}

export function ResidualOrderings({ id, found, residuals: { effects, items } }: Props) {
  const orderings = orderingsOf(items);
  const wanted = query.value.get("by");
  const ordering = orderings.find((one) => one.id === wanted) ?? causeOrdering(found, orderings);
  const before: Series = { name: t.diagnosis.beforeName, of: (row) => row.before_mm };
  const after: Series = { name: t.diagnosis.afterName, of: (row) => row.after_mm };
  const contributions = effects.map((effect, k) => ({
    name: t.diagnosis.contribution(labelsInSentence(effect)),
    of: (row: ResidualRow) => row.by_effect_mm[k]!,
  }));
  const choose = (by: string) => {
    // the zoom of one ordering is meaningless in another
    setQuery("zoom", "");
    setQuery("by", by);
  };
  const charts: ChartOf[] = [
    { title: t.diagnosis.before, series: [before, ...contributions], limit_mm: null },
    ...(effects.length > 0
      ? [{ title: t.diagnosis.after, series: [after] as [Series], limit_mm: medianLimit(items) }]
      : []),
  ];
  return (
    <section class="panel wide orderings" aria-label={t.diagnosis.residual}>
      <h2>{t.diagnosis.residualTitle}</h2>
      <div class="choices" role="group" aria-label={t.diagnosis.orderBy}>
        {orderings.map(({ id: by, name }) => (
          <button key={by} type="button" aria-pressed={by === ordering.id} onClick={() => choose(by)}>
            {name}
          </button>
        ))}
      </div>
      <Readable {...{ id, items, ordering, charts }} names={contributions.map(({ name }) => name)} />
    </section>
  );
}

interface ChartOf {
  title: string;
  series: [Series, ...Series[]];
  limit_mm: number | null;
}

interface ReadableProps {
  id: number;
  items: ResidualRow[];
  ordering: Ordering;
  charts: ChartOf[];
  /** Legend of the contributions. */
  names: string[];
}

/** Charts side by side with a common zoom and a common selected reading. */
function Readable({ id, items, ordering, charts, names }: ReadableProps) {
  const cursor = useSignal<number | null>(null);
  const order = inOrder(items, ordering);
  const whole: Span = [order[0]?.at ?? 0, order.at(-1)?.at ?? 0];
  const zooms = !ordering.words && ordering.id !== POSITION && whole[0] < whole[1];
  const span = zooms ? readSpan(query.value.get("zoom"), whole) : null;
  const zoom = (to: Span | null) => setQuery("zoom", writeSpan(to));
  const at = order.findIndex(({ index }) => index === cursor.value);
  const read = (place: number) => {
    const one = order[Math.min(Math.max(place, 0), order.length - 1)];
    if (!one) return;
    cursor.value = one.index;
    const shown = showing(whole, span, one.at);
    if (shown !== span) zoom(shown);
  };
  const middle = order[at]?.at ?? ((span ?? whole)[0] + (span ?? whole)[1]) / 2;
  const closer = () => zoom(zoomedIn(whole, span, middle));
  const further = () => zoom(zoomedOut(whole, span));
  const keys: Record<string, () => void> = {
    ArrowLeft: () => read(at - 1),
    ArrowRight: () => read(at + 1),
    Home: () => read(0),
    End: () => read(order.length - 1),
    ...(zooms && { "+": closer, "-": further }),
  };
  const pressed = (event: KeyboardEvent) => {
    const act = Object.hasOwn(keys, event.key) ? keys[event.key] : undefined;
    if (!act || event.target !== event.currentTarget) return;
    event.preventDefault();
    act();
  };
  const row = cursor.value === null ? null : (items[cursor.value] ?? null);
  return (
    <>
      <div
        class="pair"
        role="application"
        tabIndex={0}
        aria-label={t.diagnosis.how}
        aria-describedby="reading-value"
        onKeyDown={pressed}
      >
        {charts.map((chart) => (
          <OrderingChart
            key={chart.title}
            {...chart}
            {...{ id, items, ordering, span }}
            cursor={cursor.value}
            read={(index) => {
              cursor.value = index;
            }}
          />
        ))}
      </div>
      <output id="reading-value" class="value" aria-live="polite">
        {row ? readout(row, names) : `${t.diagnosis.how}.`}
      </output>
      <div class="choices" role="group" aria-label={t.diagnosis.zoom}>
        <button type="button" disabled={!zooms} onClick={closer}>
          {t.diagnosis.zoomIn}
        </button>
        <button type="button" disabled={!span} onClick={further}>
          {t.diagnosis.zoomOut}
        </button>
        <button type="button" disabled={!span} onClick={() => zoom(null)}>
          {t.diagnosis.zoomAll}
        </button>
      </div>
    </>
  );
}

function readout(row: ResidualRow, names: string[]): string {
  const um = (mm: number) => signedMicrometres(mm, 1);
  return t.listed([
    t.diagnosis.readingAt(String(row.reading), row.position),
    t.diagnosis.valueBefore(um(row.before_mm)),
    ...names.map((name, k) => t.diagnosis.valueOf(name, um(row.by_effect_mm[k]!))),
    ...(names.length > 0 ? [t.diagnosis.valueAfter(um(row.after_mm), micrometres(row.limit_mm, 1))] : []),
  ]);
}
