"""The diagnosis of logs of a real arm: errors before and after, causes, curves, validity for other logs."""

from __future__ import annotations

import math
import resource
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from station.diagnosis import (
    Curve,
    TracedFindings,
    Transfer,
    curve_chart,
    curves,
    kept_fresh,
    model_document,
    shown,
    stage_name,
    traced,
    transfer,
    without_a_quarter,
)
from station.machines import read_readings
from station.messages import effect_name
from station.records import Measured, Measurements, StageErrors
from station.report import standalone
from station.serial_arm import Arm
from station.studies.plain_pipelines import pipelines


@dataclass(frozen=True)
class Found:
    """One log by one kind of measurement: learned on three quarters, judged by the fourth."""

    log: str
    measured: Measured
    readings: int
    seconds: float
    verdict: str
    sentence: str
    stages: tuple[StageErrors, ...]
    effects: tuple[str, ...]
    """Name, share and size of each, as text."""
    curves: tuple[Curve, ...]
    tied: tuple[str, ...]
    hints: tuple[str, ...]
    left_out: tuple[int | str, ...]
    plain: Mapping[str, float]
    """RMS of the same readings by plain pipelines; empty where they are not installed."""
    predicted_rms_mm: float
    """Position error that the loop itself predicts for the poses."""


@dataclass(frozen=True)
class Study:
    """Everything that the page shows."""

    found: tuple[Found, ...]
    transfers: tuple[tuple[str, str, Transfer], ...]
    """(learned on, applied to, what came of it)"""
    memory_mb: float


def study(robot: Arm, logs: Sequence[Path]) -> Study:
    """The loop on every log, by positions and by distances alone; effects of the first applied to the others.

    :raises InputRefused: a log that is not of this robot.
    """
    found, transfers = [], []
    for path in logs:
        readings = read_readings(robot, path)
        kinds: tuple[Measured, ...] = ("position", "range") if _has_range(readings) else ("position",)
        found += [_found(robot, path, measured) for measured in kinds]
    first, *others = logs
    if others:
        whole = traced(robot, read_readings(robot, first))
        part = model_document(whole, whole.last, 1.0, stage="last", confirmed=None)
        transfers = [
            (first.stem, path.stem, transfer(part, robot, read_readings(robot, path), first.stem))
            for path in others
        ]
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    return Study(tuple(found), tuple(transfers), peak)


def _has_range(readings: Measurements) -> bool:
    return readings.tracker is not None and bool(np.isfinite(readings.distance).all())


def _found(robot: Arm, path: Path, measured: Measured) -> Found:
    began = time.perf_counter()
    readings = read_readings(robot, path, measured)
    findings = TracedFindings(traced(robot, *without_a_quarter(readings)))
    stages = findings.stages
    seconds = time.perf_counter() - began
    d = findings.diagnosis
    return Found(
        log=path.stem,
        measured=measured,
        readings=len(readings),
        seconds=seconds,
        verdict=d.verdict.replace("_", " "),
        sentence=findings.sentence,
        stages=stages,
        effects=tuple(
            f"**{effect_name(e.label, 'en')}**, {100.0 * e.share:.0f} % of the squared residual: "
            + ", ".join(f"{q.name} {shown(q)}" for q in e.parameters)
            for e in findings.effects
        ),
        curves=curves(d.last) if measured == "position" else (),
        tied=tuple(findings.weak_direction.blind),
        hints=tuple(f"{h.said.text()} ({100.0 * h.strength:.0f} %)" for h in d.hints),
        left_out=tuple(o.reading for o in d.outliers),
        plain=pipelines(d, kept_fresh(d)),
        predicted_rms_mm=findings.position_errors[1].rms,
    )


def write(result: Study, folder: Path) -> Path:
    """`figures.md` and its drawings.  :raises OSError: the folder cannot be written to."""
    page = folder / "figures.md"
    for found in result.found:
        for curve in found.curves:
            drawing = standalone(curve_chart(curve))
            (folder / _drawing(found, curve)).write_text(drawing, encoding="utf-8")
    page.write_text("\n".join(_page(result)) + "\n", encoding="utf-8")
    return page


def _drawing(found: Found, curve: Curve) -> str:
    return f"{found.log}-joint{curve.joint}.svg"


def _page(result: Study) -> Iterator[str]:
    yield "# Figures"
    yield ""
    yield (
        "`station real-robot` makes this page. All errors are RMS in mm at readings that took no part in the "
        "fit: a quarter of each log, in blocks of forty neighbours. For positions, the error is the distance "
        "in space."
    )
    yield ""
    yield (
        "| log | measured | readings | nominal links | six errors per link | with the effects found "
        "| verdict | time, s |"
    )
    yield "|---|---|---|---|---|---|---|---|"
    for f in result.found:
        nominal, base, *_, last = f.stages
        figures = " | ".join(f"{stage.confirm_rms_mm:.4f}" for stage in (nominal, base, last))
        yield f"| {f.log} | {f.measured} | {f.readings} | {figures} | {f.verdict} | {f.seconds:.0f} |"
    yield ""
    yield f"Peak memory {result.memory_mb:.0f} MB."
    if any(f.plain for f in result.found):
        yield from _comparison(result.found)
    if result.transfers:
        yield from _transfers(result.transfers)
    for f in result.found:
        yield from _causes(f)


def _comparison(found: Sequence[Found]) -> Iterator[str]:
    names = next(f.plain for f in found if f.plain)
    yield ""
    yield "## Compared with general methods"
    yield ""
    yield (
        "All methods use the same readings for the fit and the same held-out readings, in one run. Each "
        "general method predicts the residual of the fit of six errors per link (DH fit). The last column is "
        "the position error that the station predicts for the held-out poses without their readings."
    )
    yield ""
    yield f"| log | measured | {' | '.join(names)} | the station | predicted by the station |"
    yield f"|---|---|{'---|' * (len(names) + 2)}"
    for f in found:
        best = min((*f.plain.values(), f.stages[-1].confirm_rms_mm or math.inf))
        shown = [_bold(value, best) for value in (*f.plain.values(), f.stages[-1].confirm_rms_mm)]
        yield f"| {f.log} | {f.measured} | {' | '.join(shown)} | {f.predicted_rms_mm:.4f} |"


def _bold(value: float | None, best: float) -> str:
    if value is None:
        return ""
    return f"**{value:.4f}**" if value <= best else f"{value:.4f}"


def _transfers(transfers: Sequence[tuple[str, str, Transfer]]) -> Iterator[str]:
    yield ""
    yield "## Effects of one log applied to another log"
    yield ""
    yield (
        "Base, tool and links are fitted to three quarters of the new log; the effects are used unchanged. "
        "Errors are RMS in mm on the fourth quarter."
    )
    yield ""
    yield "| learned on | applied to | readings | without effects | with effects | left out |"
    yield "|---|---|---|---|---|---|"
    for learned, applied, t in transfers:
        names = ", ".join(str(o.reading) for o in t.outliers) or "none"
        yield (
            f"| {learned} | {applied}, in joint ranges that {learned} visited | {t.inside} of {t.readings} "
            f"| {t.alone.rms_mm:.4f} | {t.applied.rms_mm:.4f} | {names} |"
        )
        if t.beyond:
            yield (
                f"| | {applied}, including gaps between these ranges | | {t.beyond[0].rms_mm:.4f} "
                f"| {t.beyond[1].rms_mm:.4f} | the same |"
            )


def _causes(f: Found) -> Iterator[str]:
    yield ""
    yield f"## {f.log}, by {f.measured}"
    yield ""
    yield f.sentence
    yield ""
    yield "| model | unknowns | fit | cross-validation | held out | largest |"
    yield "|---|---|---|---|---|---|"
    for s in f.stages:
        yield (
            f"| {stage_name(s.model, 'en')} | {s.unknowns} | {s.fit_rms_mm:.4f} | {s.holdout_rms_mm:.4f} "
            f"| {s.confirm_rms_mm:.4f} | {s.confirm_max_mm:.3f} |"
        )
    yield ""
    yield from (f"- {effect}" for effect in f.effects)
    if f.curves:
        yield ""
        yield " ".join(f"![{effect_name(c.label, 'en')}]({_drawing(f, c)})" for c in f.curves)
    for what, items in (
        ("Cannot be determined: ", "; ".join(f.tied)),
        ("Dependence of the remaining residual: ", " ".join(f.hints)),
        ("Outliers, left out: reading ", ", ".join(map(str, f.left_out))),
    ):
        if items:
            yield ""
            yield what + items.rstrip(".") + "."
