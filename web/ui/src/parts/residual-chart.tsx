import { useEffect, useRef } from "preact/hooks";
import type { Calibration } from "../api";
import { fixed } from "../format";

type Residuals = NonNullable<Calibration["residuals"]>;

/** Residual of each reading against its limits.  The drawing comes when it is needed, not with the page. */
export function ResidualChart({ residuals }: { residuals: Residuals }) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let remove = () => {};
    let gone = false;
    void import("./residual-drawing").then(({ draw }) => {
      if (place.current && !gone) remove = draw(place.current, residuals);
    });
    return () => {
      gone = true;
      remove();
    };
  }, [residuals]);
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
      <div ref={place} class="chart" role="img" aria-label="Chart of the residuals against their limits" />
    </section>
  );
}
