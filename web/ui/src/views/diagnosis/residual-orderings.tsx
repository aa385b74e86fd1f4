/** The residual before and after, ordered by what may have caused it; the ordering lives in the address. */
import type { ResidualRow } from "../../api";
import { fixed } from "../../format";
import { navigate, path, query } from "../../router";
import { Drawn } from "../../parts/drawn";
import { isOver, MARKS, type Ordering, orderingsOf, PLACE, type Series } from "./orderings";

const UM = 1000;

interface Residuals {
  effects: string[];
  items: ResidualRow[];
}

export function ResidualOrderings({ id, residuals: { effects, items } }: { id: number; residuals: Residuals }) {
  const orderings = orderingsOf(items);
  const ordering = orderings.find((one) => one.id === query.value.get("by")) ?? orderings[0]!;
  const before: Series = { name: "measured less base model", of: (row) => row.before_mm };
  const after: Series = { name: "left with the effects in the model", of: (row) => row.after_mm };
  const accounted = effects.map((effect, k) => ({
    name: `${effect.replaceAll("_", " ")} accounts for`,
    of: (row: ResidualRow) => row.by_effect_mm[k]!,
  }));
  return (
    <section class="panel wide orderings" aria-label="Residual">
      <h2>Residual of each reading</h2>
      <div class="choices" role="group" aria-label="Order the residual by">
        {orderings.map(({ id: by, text }) => (
          <button
            key={by}
            type="button"
            aria-pressed={by === ordering.id}
            onClick={() => navigate(`${path.value}?by=${by}`, { replace: true })}
          >
            {text}
          </button>
        ))}
      </div>
      <div class="pair">
        <Chart {...{ id, items, ordering }} title="Before" series={[before, ...accounted]} limit_mm={null} />
        {effects.length > 0 && (
          <Chart {...{ id, items, ordering }} title="After" series={[after]} limit_mm={median(items)} />
        )}
      </div>
    </section>
  );
}

/** Limits differ a little from place to place; the line is drawn at the middle one. */
function median(items: ResidualRow[]): number {
  return items.map(({ limit_mm }) => limit_mm).sort((a, b) => a - b)[items.length >> 1]!;
}

interface ChartProps {
  id: number;
  items: ResidualRow[];
  ordering: Ordering;
  title: string;
  series: [Series, ...Series[]];
  limit_mm: number | null;
}

function Chart({ id, items, ordering, title, series, limit_mm }: ChartProps) {
  const sizes = items.map((row) => series[0].of(row) * UM);
  const rms = Math.sqrt(sizes.reduce((sum, size) => sum + size * size, 0) / sizes.length);
  const largest = Math.max(...sizes.map(Math.abs));
  return (
    <figure>
      <figcaption>
        <p>
          <strong>{title}:</strong> {fixed(rms, 2)} µm rms, largest {fixed(largest, 2)} µm
        </p>
        <p class="legend">{legend(items, ordering, series, limit_mm)}</p>
      </figcaption>
      <Drawn
        label={`${title}: ${series.map(({ name }) => name).join(", ")}, by ${ordering.text.toLowerCase()}`}
        on={`${id} ${ordering.id}`}
        load={() =>
          import("./ordering-drawing").then(
            ({ drawOrdering, drawPlaces }) =>
              (place) =>
                ordering.id === PLACE
                  ? drawPlaces(place, items, series[0])
                  : drawOrdering(place, items, ordering, series, limit_mm),
          )
        }
      />
    </figure>
  );
}

/** What each mark stands for, in a line of text. */
function legend(items: ResidualRow[], ordering: Ordering, [dots, ...marks]: Series[], limit_mm: number | null): string {
  if (ordering.id === PLACE) return `● ${dots!.name}, mean of each place; ○ negative; area by size`;
  const over = limit_mm === null ? 0 : items.filter(isOver).length;
  return [
    `● ${dots!.name}`,
    ...marks.map(({ name }, k) => `${MARKS[k % MARKS.length]!.sign} ${name}`),
    ...(limit_mm === null ? [] : [`┄ limit ${fixed(UM * limit_mm, 2)} µm`]),
    ...(over > 0 ? [`◆ ${over} over it`] : []),
  ].join("; ");
}
