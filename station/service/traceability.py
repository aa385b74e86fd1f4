"""No pass rests on a scale whose certificate does not cover the day."""

from __future__ import annotations

from datetime import date

from station.records import CalibrationResult, MadeBy, because


def traced(result: CalibrationResult, made_by: MadeBy | None, day: date) -> CalibrationResult:
    """The result as it was, or no pass where the scale is past its date.

    Where the station file names no certificate, the result stands: its uncertainty is then that of a scale
    that is as good as its specification, which the certificate of the run says.
    """
    scale = made_by.scale_certificate if made_by else None
    if result.verdict != "pass" or scale is None or scale.counts_on(day):
        return result
    reason = because(
        "scale_not_covered",
        certificate=scale.certificate,
        calibrated=scale.calibrated.isoformat(),
        due=scale.due.isoformat(),
        day=day.isoformat(),
    )
    return result.model_copy(update={"verdict": "fail", "outcome": "not_verified", "reason": reason})
