import type { Calibration } from "../../api";
import { fixed } from "../../format";
import { Drawn } from "../../parts/drawn";

type Residuals = NonNullable<Calibration["residuals"]>;

/** Residual of each reading against its limits. */
export function ResidualChart({ id, residuals }: { id: number; residuals: Residuals }) {
  if (residuals.length === 0) return null;
  const over = residuals.filter((r) => r.limit_mm !== null && Math.abs(r.residual_mm ?? 0) > r.limit_mm);
  const largest = Math.max(...residuals.map((r) => Math.abs(r.residual_mm ?? 0)));
  return (
    <section class="panel wide">
      <h2>Residual of each reading</h2>
      <p class="note">
        {residuals.length} readings, largest {fixed(largest, 4)} mm,{" "}
        {over.length === 0 ? "none over its limit." : `${over.length} over the limit (diamonds).`}
      </p>
      <Drawn
        label="Chart of the residuals against their limits"
        on={`${id} ${residuals.length}`}
        load={() => import("./residual-drawing").then(({ draw }) => (place) => draw(place, residuals))}
      />
    </section>
  );
}
