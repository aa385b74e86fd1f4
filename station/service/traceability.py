"""No result is a pass if the scale's certificate is not valid on the day."""

from __future__ import annotations

from datetime import date

from station.records import CalibrationResult, MadeBy, because


def traced(result: CalibrationResult, made_by: MadeBy | None, day: date) -> CalibrationResult:
    """The result unchanged, or without a pass if the scale's certificate has expired.

    Without a certificate in the station file the result is unchanged: its uncertainty is then that of a scale
    within its specification, which the certificate of the run states.
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
