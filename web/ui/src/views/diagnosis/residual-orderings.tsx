/** The residual before and after, ordered by what may have caused it; the ordering lives in the address. */
import { micrometres } from "../../format";
import { t } from "../../messages";
import { inSentence, labelName } from "../../names";
import { Drawn } from "../../parts/drawn";
import { navigate, path, query } from "../../router";
import type { ResidualList, ResidualRow } from "../../types";
import { isOver, MARKS, medianLimit, type Ordering, orderingsOf, POSITION, type Series } from "./orderings";

type Residuals = Pick<ResidualList, "effects" | "items">;

export function ResidualOrderings({
  id,
  residuals: { effects, items },
}: {
  id: number;
  residuals: Residuals;
}) {
  const orderings = orderingsOf(items);
  const ordering = orderings.find((one) => one.id === query.value.get("by")) ?? orderings[0]!;
  const before: Series = { name: t.diagnosis.beforeName, of: (row) => row.before_mm };
  const after: Series = { name: t.diagnosis.afterName, of: (row) => row.after_mm };
  const contributions = effects.map((effect, k) => ({
    name: t.diagnosis.contribution(inSentence(labelName(effect))),
    of: (row: ResidualRow) => row.by_effect_mm[k]!,
  }));
  return (
    <section class="panel wide orderings" aria-label={t.diagnosis.residual}>
      <h2>{t.diagnosis.residualTitle}</h2>
      <div class="choices" role="group" aria-label={t.diagnosis.orderBy}>
        {orderings.map(({ id: by, name }) => (
          <button
            key={by}
            type="button"
            aria-pressed={by === ordering.id}
            onClick={() => navigate(`${path.value}?by=${by}`, { replace: true })}
          >
            {name}
          </button>
        ))}
      </div>
      <div class="pair">
        <Chart
          {...{ id, items, ordering }}
          title={t.diagnosis.before}
          series={[before, ...contributions]}
          limit_mm={null}
        />
        {effects.length > 0 && (
          <Chart
            {...{ id, items, ordering }}
            title={t.diagnosis.after}
            series={[after]}
            limit_mm={medianLimit(items)}
          />
        )}
      </div>
    </section>
  );
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
  const sizes = items.map(series[0].of);
  const rms = Math.sqrt(sizes.reduce((sum, size) => sum + size * size, 0) / sizes.length);
  const largest = Math.max(...sizes.map(Math.abs));
  return (
    <figure>
      <figcaption>
        <p>
          <strong>{title}:</strong> {t.diagnosis.caption(micrometres(rms, 2), micrometres(largest, 2))}
        </p>
        <p class="legend">{legend(items, ordering, series, limit_mm)}</p>
      </figcaption>
      <Drawn
        label={t.diagnosis.chart(
          title,
          t.listed(series.map(({ name }) => name)),
          ordering.name.toLowerCase(),
        )}
        on={`${id} ${ordering.id}`}
        load={() =>
          import("./ordering-drawing").then(
            ({ drawOrdering, drawPositions }) =>
              (place) =>
                ordering.id === POSITION
                  ? drawPositions(place, items, series[0])
                  : drawOrdering(place, items, ordering, series, limit_mm),
          )
        }
      />
    </figure>
  );
}

/** What each mark stands for, in a line of text. */
function legend(
  items: ResidualRow[],
  ordering: Ordering,
  [dots, ...marks]: ChartProps["series"],
  limit_mm: number | null,
): string {
  if (ordering.id === POSITION) return t.diagnosis.legendMean(dots.name);
  const over = limit_mm === null ? 0 : items.filter(isOver).length;
  return [
    `● ${dots.name}`,
    ...marks.map(({ name }, k) => `${MARKS[k % MARKS.length]!.sign} ${name}`),
    ...(limit_mm === null ? [] : [t.diagnosis.legendLimit(micrometres(limit_mm, 2))]),
    ...(over > 0 ? [t.diagnosis.legendOver(over)] : []),
  ].join("; ");
}
