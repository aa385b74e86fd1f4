/** The position errors before and after, on one scale: tap a point or move with the arrow keys to read it. */
import { useSignal } from "@preact/signals";
import { errorMap } from "../../api";
import { fixed, MISSING, micrometres } from "../../format";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import type { Calibration, ErrorMap } from "../../types";
import { scaleOf } from "./colours";
import { isValid } from "./decision";
import { type Cell, kept, stepped, worst } from "./field";
import { FieldMap } from "./field-map";
import { ScaleBar } from "./scale-bar";

const DIGITS = 3;
const mm = (value: number | null | undefined) => fixed(value, DIGITS);

/** Whether a run has data to draw. */
export const hasMap = ({ kind, machine, verdict, zero_offsets }: Calibration) =>
  verdict !== null && zero_offsets.length > 0 && kind !== "rollback" && machine === "five-bar";

export function ErrorMaps({ result }: { result: Calibration }) {
  const { id, application } = result;
  const key = `${id} ${application?.state}`;
  const { value: map, trouble } = useLoaded(key, () => errorMap(id)).value;
  const valid = isValid(result) || result.outcome === "not_accurate_enough";
  return (
    <section class="panel wide error-maps" aria-label={t.result.map.title}>
      <h2>{t.result.map.title}</h2>
      {map ? <Maps map={map} valid={valid} /> : <p role="status">{trouble ?? t.shared.loading}</p>}
    </section>
  );
}

function Maps({ map, valid }: { map: ErrorMap; valid: boolean }) {
  const cursor = useSignal<Cell | null>(null);
  const grid = { x: map.x_mm, y: map.y_mm };
  const { limit_mm: limit } = map;
  const scale = scaleOf([
    ...[map.before_mm, map.after_95_mm].flat(2).filter((value) => value !== null),
    ...(limit === null ? [] : [limit]),
  ]);
  const at = cursor.value ?? worst(map.after_95_mm);
  const read = (cell: Cell) => {
    cursor.value = cell;
  };
  const pressed = (event: KeyboardEvent) => {
    const next = event.key === "Home" ? worst(map.after_95_mm) : stepped(grid, at, event.key);
    if (!next) return;
    event.preventDefault();
    read(next);
  };
  return (
    <>
      <div
        class="maps"
        role="application"
        tabIndex={0}
        aria-label={t.result.map.how}
        aria-describedby="map-value"
        onKeyDown={pressed}
        onFocus={() => read(at)}
      >
        <FieldMap
          {...{ grid, scale, limit, read }}
          name={t.result.map.before}
          values={map.before_mm}
          cursor={cursor.value}
        />
        <FieldMap
          {...{ grid, scale, limit, read }}
          name={t.result.map.after}
          values={map.after_95_mm}
          dots={map.fresh}
          cursor={cursor.value}
        />
      </div>
      <ScaleBar scale={scale} limit={limit} />
      <output id="map-value" class={valid ? "value" : "value not-valid"} aria-live="polite">
        {valueAt(map, at)}
      </output>
      <p class="note">
        {valid ? limitText(map) : t.result.map.notValid} {freshText(map.fresh)} {t.result.map.how}.
      </p>
    </>
  );
}

function limitText({ limit_mm, after_95_mm }: ErrorMap): string {
  if (limit_mm === null) return t.result.map.noLimit;
  return t.result.map.limit[kept(after_95_mm, limit_mm)](mm(limit_mm));
}

function valueAt(map: ErrorMap, { i, j }: Cell): string {
  const values = [map.before_mm, map.after_95_mm, map.after_mm].map((grid) => grid[j]?.[i]);
  const [before, bound, expected] = values.map(mm);
  const where = [map.x_mm[i], map.y_mm[j]].map((value) => fixed(value, 0)) as [string, string];
  return values[0] == null
    ? t.result.map.closed(...where)
    : t.result.map.value(...where, before ?? MISSING, bound ?? MISSING, expected ?? MISSING);
}

function freshText(fresh: ErrorMap["fresh"]): string {
  if (fresh.length === 0) return t.result.map.noFresh;
  const sizes = fresh.map(({ residual_mm }) => Math.abs(residual_mm));
  const rms = Math.sqrt(sizes.reduce((sum, size) => sum + size * size, 0) / sizes.length);
  return t.result.map.fresh(fresh.length, micrometres(rms, 1), micrometres(Math.max(...sizes), 1));
}
