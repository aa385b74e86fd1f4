import { micrometres } from "../../format";
import { t } from "../../messages";
import { Drawn } from "../../parts/drawn";
import type { Residual } from "../../types";
import { isOver } from "./over-limit";

interface Props {
  id: number;
  residuals: Residual[];
  /** Another run that is drawn on the same scale. */
  beside?: Residual[];
}

/** Residual of each reading against its limits. */
export function ResidualChart({ id, residuals, beside }: Props) {
  if (residuals.length === 0) return null;
  const largest = Math.max(...residuals.map(({ residual_mm }) => Math.abs(residual_mm ?? 0)));
  const over = residuals.filter(isOver).length;
  return (
    <>
      <p class="note">{t.result.residualsNote(residuals.length, micrometres(largest, 1), over)}</p>
      <Drawn
        label={t.result.residualsChart}
        on={`${id} ${residuals.length}`}
        load={() =>
          import("./residual-drawing").then(
            ({ draw, reachOf }) =>
              (place) =>
                draw(place, residuals, beside && reachOf([...residuals, ...beside])),
          )
        }
      />
    </>
  );
}
