"""Evaluation of gauge studies for the station: runs of one robot each, all of the same design.

Each calibration of a study is identified by its own readings alone.  The contributions of the readout, the
drives and the solver to its scatter are computed from its readings: the scatter of the samples of a reading,
that of readings with the same position and approach, and that of results from other starts, each propagated
through the fit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from station.errors import NotApplicable
from station.five_bar import SCALE_SD_MM, FiveBar
from station.identification import Identification
from station.model import fit
from station.quality import JointGauge, joint_gauge
from station.records import Reading, Real, Record, State, StudyDesign
from station.run_kinds.fits import fit_of
from station.run_kinds.gauge_study import KIND, by_sequence, design_of, in_cells, mountings_taken
from station.run_kinds.kind import robot_as_measured
from station.store import Store

Schema = Literal["station.gauge-study/1"]
STARTS = 4
"""Start points from which each fit is solved again."""
SEED = 18


class Sources(Record):
    """Contributions to the gauge's scatter: standard deviations in degrees."""

    readout: float
    drives: float
    """Scatter of readings with the same position and approach, beyond that of the readout."""
    solver: float
    """Scatter between different starts of the fit."""
    unexplained: float
    """Part of the scatter with one mounting that readout, drives and solver do not account for."""
    mounting: float
    operators: float
    percent: dict[str, float]
    """Percentages of the gauge's variance; they add up to 100."""


class JointStudied(JointGauge):
    """One joint with the sources of its scatter."""

    sources: Sources


class StudiedValue(Record):
    """One calibration of a study."""

    run: int
    robot: str
    operator: int
    mounting: int
    """1, 2, ... of this operator."""
    repeat: int
    dtheta_deg: tuple[float, float]


class StationGauge(Record):
    """Gauge study of a station."""

    schema_: Annotated[Schema, Field(alias="schema")] = "station.gauge-study/1"
    runs: tuple[int, ...]
    robots: tuple[str, ...]
    design: StudyDesign
    people: tuple[tuple[str, ...], ...]
    """Who confirmed the mountings of operator 1, 2, ..."""
    tolerance_deg: float
    """Width of the tolerance interval of a zero offset."""
    joints: tuple[JointStudied, JointStudied]
    values: tuple[StudiedValue, ...]


def station_gauge(store: Store, runs: Sequence[int], zero_offset_deg: float) -> StationGauge:
    """The evaluation of finished gauge studies, one per robot.

    :param zero_offset_deg: tolerance of a zero offset, to either side
    :raises NotFound: no such run.
    :raises NotApplicable: a run is no finished gauge study, or it does not match the others; the error states
    which.
    """
    designs = {run: _design(store, run) for run in runs}
    robots = [store.summary(run).robot_serial for run in runs]
    first = runs[0]
    for run, serial in zip(runs[1:], robots[1:], strict=True):
        if designs[run] != designs[first]:
            raise NotApplicable(
                f"Runs {first} and {run} differ in operators, mountings or repeats; evaluate them apart."
            )
        if robots.index(serial) < runs.index(run):
            raise NotApplicable(f"Robot {serial} is in two of these runs; give one study of each robot.")
    design = designs[first]
    studies = [_calibrations(store, run) for run in runs]
    values = np.array([in_cells([one.zeros_deg for one in of], design) for of in studies])
    caused = np.mean([[one.caused() for one in of] for of in studies], axis=(0, 1))  # (3, 2) variances
    tolerance_deg = 2.0 * zero_offset_deg
    one, two = (_studied(joint_gauge(j + 1, values[..., j], tolerance_deg), caused[:, j]) for j in range(2))
    return StationGauge(
        runs=tuple(runs),
        robots=tuple(robots),
        design=design,
        people=_people(store, runs, design),
        tolerance_deg=tolerance_deg,
        joints=(one, two),
        values=tuple(
            StudiedValue(
                run=runs[p],
                robot=robots[p],
                operator=o + 1,
                mounting=m + 1,
                repeat=r + 1,
                dtheta_deg=(float(values[p, o, m, r, 0]), float(values[p, o, m, r, 1])),
            )
            for p, o, m, r in np.ndindex(*values.shape[:4])
        ),
    )


@dataclass(frozen=True)
class _Calibration:
    """One sequence of a study, identified by its own readings."""

    fit: Identification[FiveBar]
    readings: Sequence[Reading]

    @property
    def zeros_deg(self) -> Real:
        """(2,)"""
        return np.asarray(np.degrees(self.fit.dtheta))

    def caused(self) -> Real:
        """(3, 2) variances of the zero offsets from readout, drives and solver, deg^2."""
        found = self.fit.fit
        solution = found.solution
        gain = (solution.covariance @ solution.jacobian.T)[:2]  # (2, R): offsets by whitened error
        sd_mm = self._readout_sd_mm()
        readout = np.sum((gain * (sd_mm / found.row_sd)) ** 2, axis=1)
        repeats = np.sum(gain**2, axis=1)
        rng = np.random.default_rng(SEED)
        mechanism = self.fit.mechanism
        spread = np.array([p.prior_sd for p in mechanism.parameters])
        spread = np.where(np.isfinite(spread), spread, 0.0)
        starts = mechanism.start + spread * rng.normal(size=(STARTS, len(spread)))
        others = [fit(found.model, found.prior, found.row_sd, start).x[:2] for start in starts]
        solver = np.mean((np.array(others) - found.x[:2]) ** 2, axis=0)
        parts = np.array([readout, np.maximum(repeats - readout, 0.0), solver])
        return np.asarray(parts * np.degrees(1.0) ** 2)

    def _readout_sd_mm(self) -> float:
        """Standard deviation of a reading, from its samples; from the specification if none are stored."""
        kept = [r.samples_mm for r in self.readings if len(r.samples_mm) > 1]
        variances = [np.var(samples, ddof=1) / len(samples) for samples in kept]
        if not variances:
            return float(np.sqrt(np.mean(SCALE_SD_MM**2 / self.fit.measurements.samples)))
        return float(np.sqrt(np.mean(variances)))


def _design(store: Store, run: int) -> StudyDesign:
    summary = store.summary(run)
    if summary.kind != KIND or summary.state is not State.SUCCEEDED:
        raise NotApplicable(f"Run {run} is no finished gauge study.")
    return design_of(store, run)


def _calibrations(store: Store, run: int) -> list[_Calibration]:
    robot = robot_as_measured(store, store.calibration(run))
    return [_Calibration(fit_of(robot, t, None, 0.0), t) for t in by_sequence(store.readings(run))]


def _studied(found: JointGauge, caused: Real) -> JointStudied:
    """:param caused: (3,) variances from readout, drives and solver, deg^2"""
    square = found.repeat**2
    explained = float(caused.sum())
    unexplained = max(square - explained, 0.0)
    # the computed contributions may exceed the scatter of the few repeats: then they share that scatter
    share = square / max(explained + unexplained, np.finfo(float).tiny)
    readout, drives, solver = (float(part) for part in caused)
    variances = {
        "readout": readout * share,
        "drives": drives * share,
        "solver": solver * share,
        "unexplained": unexplained * share,
        "mounting": found.mounting**2,
        "operators": found.av**2,
    }
    total = sum(variances.values())
    sources = Sources(
        readout=float(np.sqrt(readout)),
        drives=float(np.sqrt(drives)),
        solver=float(np.sqrt(solver)),
        unexplained=float(np.sqrt(unexplained)),
        mounting=found.mounting,
        operators=found.av,
        percent={name: 100.0 * v / total if total > 0.0 else 0.0 for name, v in variances.items()},
    )
    return JointStudied(**dict(found), sources=sources)


def _people(store: Store, runs: Sequence[int], design: StudyDesign) -> tuple[tuple[str, ...], ...]:
    """For each operator, everyone who confirmed one of their mountings that were used."""
    confirmed: list[set[str]] = [set() for _ in range(design.operators)]
    for run in runs:
        of: int | None = run
        later = design.all_mountings
        while of is not None:
            answers = [event for event in store.events(of) if event.kind == "answer"]
            earlier = store.summary(of).of
            first = mountings_taken(store, earlier) if earlier is not None else 0
            for mounting, answer in enumerate(answers[: later - first], start=first):
                confirmed[design.operator_of(mounting) - 1].add(str(answer.data["by"]))
            of, later = earlier, first
    return tuple(tuple(sorted(names)) for names in confirmed)
