"""The closed loop on the machine: sequence, residual, cause, model, confirmation with fresh readings."""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Generator

import numpy as np

from station.diagnosis import Context, Findings, diagnose, findings_of
from station.five_bar import Robot
from station.identification import PLAN_ENDED, advice_of, identify, with_accuracy
from station.plans import diagnostic_fresh_stops, make_plan
from station.records import (
    Accuracy,
    AccuracyReached,
    CalibrationResult,
    DataSource,
    Measurements,
    MeasurementSequence,
    Procedure,
    Reading,
    ReferenceUse,
    StageAccuracy,
    from_readings,
    readings_to_csv,
    residual_rows,
)
from station.run_kinds.kind import RunKind, Start, register

METHOD = "diagnosis"
COMPLETE = ("good", "not_accurate_enough")
"""Outcomes with no effect missing from the model that advice is computed with."""


def start_diagnostic(start: Start) -> Procedure:
    """The procedure, not yet started."""
    return diagnostic(start.robot, start.wanted_mm)


def diagnostic(
    robot: Robot, wanted_mm: float | None = None
) -> Generator[MeasurementSequence, list[Reading], CalibrationResult]:
    """Find the cause of the residual, then confirm it with fresh readings.

    :raises InputRefused: there are too few readings, or they are impossible for this robot.
    """
    readings = yield MeasurementSequence("Looking for the cause", 1, make_plan("diagnostic", robot).stops)
    return (yield from judged(robot, readings, wanted_mm))


def judged(
    robot: Robot, readings: list[Reading], wanted_mm: float | None = None
) -> Generator[MeasurementSequence, list[Reading], CalibrationResult]:
    """The cause found from readings, confirmed with fresh ones at other positions.

    :raises InputRefused: as `diagnose`.
    """
    sequence = from_readings(readings)
    found = findings_of(diagnose(robot, sequence))
    zeros = np.radians([q.value for q in found.parameters[:2]])
    fresh = yield MeasurementSequence(
        "Confirming at fresh positions", 2, diagnostic_fresh_stops(robot, zeros, _seed(sequence)), last=True
    )
    result = concluded(robot, [*readings, *fresh], wanted_mm)
    if result.outcome in COMPLETE:
        return result.model_copy(update={"advice": advice_of(identify(robot, sequence))})
    return result


def concluded(robot: Robot, readings: list[Reading], wanted_mm: float | None = None) -> CalibrationResult:
    """The result of all readings of a run.

    :raises InputRefused: as `diagnose`.
    """
    found = diagnosed(robot, readings)
    learned = [r for r in readings if r.sequence == 1]
    result = result_of(found, learned, _described(learned), robot)
    after = result.after.predicted_position_error_mm if result.after else None
    bound_mm, model_mm = found.zeros_only_bound_mm, after.bound_95 if after else None
    return with_accuracy(result, AccuracyReached.of(bound_mm, model_mm, wanted_mm, PLAN_ENDED))


def diagnosed(robot: Robot, readings: list[Reading], context: Context | None = None) -> Findings:
    """The diagnosis of a run's readings: it learns from the first sequence and confirms with later ones.

    :param context: what their file recorded; None: inferred from the readings
    :raises InputRefused: as `diagnose`.
    """
    learned = [r for r in readings if r.sequence == 1]
    fresh = [r for r in readings if r.sequence > 1]
    later = from_readings(fresh) if fresh else None
    return findings_of(diagnose(robot, from_readings(learned), later, context))


def result_of(
    findings: Findings, readings: list[Reading], data: DataSource, robot: Robot | None = None
) -> CalibrationResult:
    """The result of the run; `readings` are those that were learned from, `data` describes their source.

    It is a pass only if the robot may be used as it is: the model is complete, and fresh readings confirm it.
    """
    document = findings.document(data)
    by_id = {r.reading: r for r in readings}
    kept = [by_id[int(number)] for number in findings.measurements.ids]
    references = robot.references if robot else ()
    outcome, residual = findings.decision.outcome, findings.residual
    return CalibrationResult(
        verdict="pass" if outcome == "good" else "fail",
        outcome=outcome,
        reason=findings.reason,
        method=METHOD,
        zero_offsets=findings.parameters[:2],
        parameters=findings.parameters[2:],
        weak_direction=findings.weak_direction,
        before=stage_accuracy(document.before),
        after=stage_accuracy(document.after),
        residuals=residual_rows(kept, residual.after_mm, residual.limit_mm),
        references=tuple(
            ReferenceUse(reference=r, residual=None, sd=None, unit=r.unit, p_value=None) for r in references
        ),
        findings=document.findings,
        diagnosis=document,
    )


def _described(readings: list[Reading]) -> DataSource:
    """The source of a document, as in its `data`."""
    text = readings_to_csv(readings).encode()
    digest = hashlib.sha256(text).hexdigest()
    return DataSource(file="measurement sequence 1", readings=len(readings), sha256=digest)


def stage_accuracy(stage: StageAccuracy) -> Accuracy:
    """The accuracy of a stage as a result shows it."""
    return Accuracy(
        reading_rms_mm=stage.fit_rms_mm,
        fresh_reading_rms_mm=stage.confirm_rms_mm,
        predicted_position_error_mm=stage.predicted_position_error_mm,
    )


def _seed(sequence: Measurements) -> int:
    """Seed from the readings: new positions for each run, reproducible from the stored readings."""
    return zlib.crc32(np.ascontiguousarray(sequence.distance).tobytes())


def concluded_again(start: Start, readings: list[Reading]) -> CalibrationResult:
    """The result of the stored readings of a run."""
    return concluded(start.robot, readings, start.wanted_mm)


DIAGNOSE = register(RunKind("diagnose", start_diagnostic, concluded=concluded_again))
