/** One chart of the residual, with its legend in words; its drawing code is loaded when it is needed. */
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { micrometres } from "../../format";
import { t } from "../../messages";
import { saveFile } from "../../parts/save-file";
import type { ResidualRow } from "../../types";
import type { draw, Shown } from "./ordering-drawing";
import { contributionLine, isOver, MARKS, type Ordering, POSITION, type Series } from "./orderings";
import type { Span } from "./zoom";

type Drawing = ReturnType<typeof draw>;

interface Props {
  id: number;
  title: string;
  items: ResidualRow[];
  ordering: Ordering;
  series: [Series, ...Series[]];
  limit_mm: number | null;
  span: Span | null;
  cursor: number | null;
  read: (index: number) => void;
}

export function OrderingChart({ id, title, items, ordering, series, limit_mm, span, cursor, read }: Props) {
  const place = useRef<HTMLDivElement>(null);
  const drawing = useRef<Drawing | null>(null);
  const trouble = useSignal(false);
  const shown: Shown = { rows: items, ordering, series, limit_mm, span, cursor };
  // use the values that changed while the drawing code was loading
  const latest = useRef(shown);
  latest.current = shown;
  useEffect(() => {
    let gone = false;
    import("./ordering-drawing").then(
      (loaded) => {
        if (!gone && place.current) drawing.current = loaded.draw(place.current, latest.current, read);
      },
      // the station went down before it had sent the drawing code
      () => {
        trouble.value = true;
      },
    );
    return () => {
      gone = true;
      drawing.current?.remove();
      drawing.current = null;
    };
  }, [id]);
  useEffect(() => drawing.current?.show(shown), [ordering.id, span?.[0], span?.[1], cursor]);
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
      <div
        ref={place}
        class="chart"
        role="img"
        aria-label={t.diagnosis.chart(
          title,
          t.listed(series.map(({ name }) => name)),
          ordering.name.toLowerCase(),
        )}
      />
      <p class="note" role="status" hidden={!trouble.value}>
        {t.shared.chartMissing}
      </p>
      <button
        type="button"
        onClick={() => {
          const picture = drawing.current?.picture();
          if (picture) saveFile(t.diagnosis.pictureName(id, ordering.id, title), "image/svg+xml", picture);
        }}
      >
        {t.diagnosis.savePicture(title)}
      </button>
    </figure>
  );
}

/** The meaning of each mark, in a line of text. */
function legend(
  items: ResidualRow[],
  ordering: Ordering,
  [dots, ...effects]: Props["series"],
  limit_mm: number | null,
): string {
  if (ordering.id === POSITION) return t.diagnosis.legendMean(dots.name);
  const over = limit_mm === null ? 0 : items.filter(isOver).length;
  const sign = (effect: Series, k: number) =>
    contributionLine(items, ordering, effect) ? "━" : MARKS[k % MARKS.length]!.sign;
  return [
    `● ${dots.name}`,
    ...effects.map((effect, k) => `${sign(effect, k)} ${effect.name}`),
    ...(limit_mm === null ? [] : [t.diagnosis.legendLimit(micrometres(limit_mm, 2))]),
    ...(over > 0 ? [t.diagnosis.legendOver(over)] : []),
  ].join("; ");
}
