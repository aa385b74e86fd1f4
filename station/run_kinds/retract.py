"""The recovery run: a stop, a crash or a power failure may leave the arm where no other run may start."""

from __future__ import annotations

import math
from collections.abc import Generator

from station.records import CalibrationResult, Procedure, Reason, Retract, because
from station.run_kinds.kind import RunKind, Start, register


def retract(start: Start) -> Procedure:
    """The procedure that brings the arm back into the workspace, not yet started."""
    return _retracted()


def _retracted() -> Generator[Retract, float, CalibrationResult]:
    stood_mm = yield Retract("Back into the workspace", 1)
    return CalibrationResult(
        verdict="pass", outcome="good", reason=_reason(stood_mm), method="retract", zero_offsets=()
    )


def _reason(stood_mm: float) -> Reason:
    if stood_mm <= 0.0:
        return because("stands_inside")
    if not math.isfinite(stood_mm):
        return because("retracted_from_afar")
    return because("retracted", from_mm=round(stood_mm, 1))


RETRACT = register(RunKind("retract", retract, from_outside=True, judged=False))
