"""The closed loop on the machine: walk, residual, cause, model, fresh readings that judge it."""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Generator
from typing import Any

import numpy as np

from station.diagnosis import Findings, diagnose
from station.five_bar import Robot
from station.identification import LIMIT_SDS, with_best_remedy
from station.plans import fresh_stops, make_plan
from station.records import CalibrationResult, Measurements, Reading, Walk, from_readings, readings_to_csv

METHOD = "diagnosis"
UNCONFIRMED = "; no fresh readings confirm it"


def diagnostic(robot: Robot) -> Generator[Walk, list[Reading], CalibrationResult]:
    """Find the cause of what the model leaves over, then judge it by fresh readings.

    :raises InputRefused: the readings are not enough to judge, or not of this robot.
    """
    readings = yield Walk("Looking for the cause", 1, make_plan("diagnostic", robot).stops)
    return (yield from judged(robot, readings))


def judged(robot: Robot, readings: list[Reading]) -> Generator[Walk, list[Reading], CalibrationResult]:
    """What readings tell of the cause, judged by fresh ones at other places.

    :raises InputRefused: as `diagnose`.
    """
    walk = from_readings(readings)
    fit = Findings(diagnose(robot, walk)).fit
    fresh = yield Walk("Confirming at fresh places", 2, fresh_stops(robot, fit.x[:2], _seed(walk)))
    return result_of(diagnosed(robot, [*readings, *fresh]), readings, _described(readings))


def diagnosed(robot: Robot, readings: list[Reading]) -> Findings:
    """The diagnosis of a run's readings: the first walk is learned from, later ones judge.

    :raises InputRefused: as `diagnose`.
    """
    learned = [r for r in readings if r.walk == 1]
    fresh = [r for r in readings if r.walk > 1]
    return Findings(diagnose(robot, from_readings(learned), from_readings(fresh) if fresh else None))


def result_of(findings: Findings, readings: list[Reading], data: dict[str, Any]) -> CalibrationResult:
    """What the run ends with; `readings` are those that were learned from, `data` says where from.

    Only what fresh readings confirm is a pass.
    """
    document = findings.as_json(data)
    last = findings.diagnosis.last
    position = {r.reading: r.position for r in readings}
    return CalibrationResult(
        verdict="pass" if findings.passed and findings.diagnosis.confirmed else "fail",
        reason=reason(findings),
        method=METHOD,
        zero_offsets=findings.parameters[:2],
        parameters=findings.parameters[2:],
        weak_direction=with_best_remedy(findings.weak_direction),
        before=_errors(document["before"]),
        after=_errors(document["after"]),
        iterations=(),
        residuals=tuple(
            {
                "reading": number,
                "position": position[int(number)],
                "residual_mm": float(residual),
                "limit_mm": LIMIT_SDS * float(sd),
            }
            for number, residual, sd in zip(
                findings.diagnosis.measurements.ids, last.residual_mm, last.row_sd, strict=True
            )
        ),
        findings=tuple(document["findings"]),
        diagnosis=document,
    )


def reason(findings: Findings) -> str:
    """The verdict in one plain sentence for the operator."""
    d = findings.diagnosis
    names = " and ".join(found.term.effect.label.replace("_", " ") for found in findings.effects)
    s = "" if len(findings.effects) > 1 else "s"
    depends = f" depends on {d.hints[0].depends_on}" if d.hints else " is not noise"
    share = f"{names} explain{s} {100.0 * d.explained_share:.1f} % of the residual"
    match d.verdict:
        case "adequate":
            predicts = " and predicts fresh ones" if d.confirmed else UNCONFIRMED
            return f"nothing is missing: the model fits the readings{predicts}"
        case "explained":
            return share + (f" and predict{s} fresh readings" if d.confirmed else UNCONFIRMED)
        case "partly_explained" if d.confirmed is False:
            return f"not explained: {share}, but fresh readings are not predicted; the residual{depends}"
        case "partly_explained":
            return f"{share}; the rest{depends}"
        case _:
            return f"unexplained: the residual{depends}"


def _described(readings: list[Reading]) -> dict[str, Any]:
    """What a document was made from, as its `data` says."""
    text = readings_to_csv(readings).encode()
    return {"file": "first walk", "readings": len(readings), "sha256": hashlib.sha256(text).hexdigest()}


def _errors(stage: dict[str, Any]) -> dict[str, Any]:
    return {
        "reading_rms_mm": stage["fit_rms_mm"],
        "fresh_reading_rms_mm": stage["confirm_rms_mm"],
        "predicted_position_error_mm": stage["predicted_position_error_mm"],
    }


def _seed(walk: Measurements) -> int:
    """From the readings themselves: new places each run, and the same again from what is stored."""
    return zlib.crc32(np.ascontiguousarray(walk.distance).tobytes())
