import type { Residual } from "../../types";

/** A residual without a limit does not exceed it. */
export const isOver = ({ residual_mm, limit_mm }: Residual) =>
  residual_mm !== null && limit_mm !== null && Math.abs(residual_mm) > limit_mm;
