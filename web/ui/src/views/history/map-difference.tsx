/** Where the second of two runs has larger or smaller position errors than the first. */
import { errorMap } from "../../api";
import { fixed } from "../../format";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import type { ErrorMap } from "../../types";
import { evenScale } from "../result/colours";
import type { Values } from "../result/field";
import { FieldMap } from "../result/field-map";
import { ScaleBar } from "../result/scale-bar";

export function MapDifference({ a, b }: { a: number; b: number }) {
  const { value: maps, trouble } = useLoaded(`maps ${a} ${b}`, () =>
    Promise.all([errorMap(a), errorMap(b)]),
  ).value;
  if (!maps) return <p role="status">{trouble ?? t.shared.loading}</p>;
  const [first, second] = maps;
  const values = difference(first, second);
  if (values === null) return <p role="status">{t.history.otherWorkspace}</p>;
  const known = values.flat().filter((value) => value !== null);
  const largest = known.reduce((most, value) => (Math.abs(value) > Math.abs(most) ? value : most), 0);
  const scale = evenScale(Math.abs(largest));
  return (
    <div class="map-difference">
      <FieldMap
        name={t.history.mapDifference(b, a)}
        grid={{ x: second.x_mm, y: second.y_mm }}
        values={values}
        scale={scale}
        limit={null}
        cursor={null}
        read={() => undefined}
      />
      <ScaleBar scale={scale} limit={null} />
      <p class="note">{t.history.largestDifference(fixed(largest, 3))}</p>
    </div>
  );
}

/** The 95 % bounds of the second less those of the first; null if the two maps have different workspaces. */
export function difference(first: ErrorMap, second: ErrorMap): Values | null {
  const same = (one: readonly number[], other: readonly number[]) =>
    one.length === other.length && one.every((value, k) => value === other[k]);
  if (!same(first.x_mm, second.x_mm) || !same(first.y_mm, second.y_mm)) return null;
  return second.after_95_mm.map((row, j) =>
    row.map((value, i) => {
      const before = first.after_95_mm[j]?.[i];
      return value === null || before == null ? null : value - before;
    }),
  );
}
