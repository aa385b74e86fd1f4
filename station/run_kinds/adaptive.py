"""Plan `adaptive`: the next position is the one with the largest benefit for the accuracy per second.

It stops when the bound is met and the readings could have contradicted a wrong memory; if the requirement
cannot be met, it stops early.  Each reading is predicted before it is used: that is its verification.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from station.errors import InputRefused
from station.fitting import NotConvergedError
from station.five_bar import HOME, FiveBar, Robot, inverse
from station.identification import (
    GATE_P,
    Identification,
    Known,
    accuracy_of,
    advice_of,
    bounds_mm,
    expected_bound_mm,
    not_identified,
    predicted_result,
    with_accuracy,
    without_jump,
)
from station.plans import (
    Contradiction,
    Pace,
    Quickest,
    candidates,
    changes_of,
    full_positions,
    gains,
    inset_grid,
    with_readings,
)
from station.records import (
    Beforehand,
    CalibrationResult,
    Complex,
    MeasurementSequence,
    Phrase,
    Procedure,
    Reading,
    Real,
    Stop,
    phrase,
)
from station.run_kinds.fits import aged, with_memory_use

FEWEST = 4
"""Minimum number of readings: two zero offsets, the offset of the readout, and one that is predicted."""
FEWEST_WITHOUT_MEMORY = 6
"""The same where only the tolerances of geometry and mechanism are known."""
MOST_AT_ONCE = 6
MOST = 120
FIRST_GRID = (7, 4)
RECENT, APART_DEG = 12, 1.0
"""A position must be this far from those of this many previous readings: others have more information."""
NEAR, NEARER = 1.1, 1.05
"""Share of the best achievable bound at which further readings are not worth their time, and the share that
the first readings aim at.
"""
TIGHTEST = 1.02
"""The same where the requirement is tighter than that."""
LOOSEST = 1e3
"""The same where the requirement is met by any readings; its square remains a number."""
CLEARLY = 1.15
"""Share of the requirement above which the best bound must be before a run stops early."""
POWER = 0.985
CONTRADICTED_P = 1e-4
"""p-value of a memory that is dropped before the run would stop."""
REMOUNT_MM, LINK_MM = 1.0, 0.3
"""Changes since the last run that must be detected."""
OTHER_TYPE_MM = 1.0
"""Deviation of a link for a robot that is not of the type of the others in its prior."""
VISIBLE_SDS = 5.0
"""Only if a full run would see them with this many standard deviations."""
FULL_VISITS = 5
GEOMETRY = slice(2, 10)
"""Indices of the geometry among the unknowns."""

MOST_TAKEN = phrase("most_readings_taken")


@dataclass(frozen=True)
class Aim:
    """The target of a run, and its candidates."""

    wanted_mm: float | None
    pace: Pace
    places: Complex
    """(N,) mm, candidates."""
    first: Complex
    """(28,) mm, candidates of the first readings."""
    of_full: Complex
    """(24,) mm, positions of a full run."""

    @classmethod
    def of(cls, robot: Robot, wanted_mm: float | None, pace: Pace) -> Aim:
        """:raises InputRefused: the scale's travel does not cover the workspace."""
        first = inset_grid(robot, *FIRST_GRID)
        return cls(wanted_mm, pace, candidates(robot), first, full_positions(robot))


@dataclass(frozen=True)
class Situation:
    """The current knowledge, and the decision on the next step."""

    known: Known
    aim: Aim
    here_deg: Real
    """(2,) current joint angles."""

    @cached_property
    def bound_mm(self) -> float:
        """The bound with the zeros in the drives only."""
        return bounds_mm(self.known.found)[0]

    @cached_property
    def best_mm(self) -> float:
        """The bound that the number of readings of a full run could reach, on average."""
        rows = replace(self.known, samples=self.aim.pace.samples).rows(self.aim.of_full)
        left = with_readings(self.known.covariance, np.repeat(rows, FULL_VISITS, axis=0))
        return expected_bound_mm(*self.known.position_jacobian(), self.known.covariance, _positive(left))

    @cached_property
    def _rows_of_full(self) -> Real:
        """(120, P) rows of as many readings as a full run has, each with one sample: a conservative basis for
        detectable changes and for the accuracy of few readings.
        """
        return np.repeat(self.known.rows(self.aim.of_full), FULL_VISITS, axis=0)

    @cached_property
    def trusted(self) -> bool:
        """Whether the readings could have contradicted a wrong memory."""
        if len(self.known.readings) < self._fewest:
            return False
        if self.known.memory is None:
            return True
        test, changes = self._test
        information = self._information
        found = test.power(test.noncentrality(information, changes), test.directions(information))
        return not len(found) or float(found.mean()) >= POWER

    @property
    def _fewest(self) -> int:
        return FEWEST if self.known.measured_before else FEWEST_WITHOUT_MEMORY

    def stops_because(self) -> Phrase | None:
        """The reason to stop; None: continue."""
        if not self.trusted:
            return MOST_TAKEN if len(self.known.readings) >= MOST else None
        if self.aim.wanted_mm is not None:
            if self.bound_mm <= self.aim.wanted_mm:
                return phrase("wanted_accuracy_reached")
            if self.best_mm > CLEARLY * self.aim.wanted_mm:
                return phrase("wanted_accuracy_out_of_reach")
        elif self.bound_mm <= NEAR * self.best_mm:
            return phrase("readings_would_not_help")
        return MOST_TAKEN if len(self.known.readings) >= MOST else None

    def first_places(self) -> list[complex]:
        """The fastest few positions that should be sufficient, before the zero offsets are known."""
        places, known = self.aim.first, self.known
        test, changes = self._test if known.memory else (None, np.zeros((0, 0)))
        weight, stays = self._by_zeros
        best = stays + float(np.trace(with_readings(known.covariance, self._rows_of_full) @ weight))
        wanted = self.aim.wanted_mm
        spare = NEARER if wanted is None else min(max(TIGHTEST, wanted / self.best_mm), LOOSEST)
        chosen = Quickest(
            covariance=known.covariance,
            rows=known.rows(places),
            weight=weight,
            stays=stays,
            enough=best * spare**2,
            theta_deg=self._commands(places),
            here_deg=self.here_deg,
            pace=self.aim.pace,
            test=test,
            changes=changes,
            power=POWER,
        ).choose(self._fewest, MOST_AT_ONCE)
        return [complex(places[k]) for k in chosen]

    def next_place(self) -> complex:
        """The position with the largest benefit of one more reading per second."""
        places = self.aim.places
        theta_deg = self._commands(places)
        duration_s = self.aim.pace.duration_s(self.here_deg[None], theta_deg, np.zeros_like(theta_deg))
        recent = np.array([r.theta_deg for r in self.known.readings[-RECENT:]])
        apart_deg = np.abs(theta_deg[:, None] - recent[None]).max(axis=2)
        fresh = (apart_deg > APART_DEG).all(axis=1)
        return complex(places[int(np.argmax(np.where(fresh, self._worth(places) / duration_s, -np.inf)))])

    def stop_at(self, place: complex) -> Stop:
        """A stop commanded with the current zero offsets."""
        theta_deg = self._commands(np.array([place]))[0]
        return Stop(
            position=f"A{len(self.known.readings) + 1}",
            target_mm=(place.real, place.imag),
            theta_deg=(float(theta_deg[0]), float(theta_deg[1])),
        )

    def _commands(self, places: Complex) -> Real:
        return np.degrees(inverse(self.known.robot.geometry, places) - self.known.estimate[:2])

    @cached_property
    def _weight(self) -> Real:
        """(P, P) M: trace(C M) is the mean square position error."""
        jacobian = self.known.position_jacobian()[1]
        return np.asarray(np.einsum("gdi,gdj->ij", jacobian, jacobian) / len(jacobian))

    @cached_property
    def _by_zeros(self) -> tuple[Real, float]:
        """The same with the zeros in the drives only: M, and the remaining error of the geometry, mm^2."""
        weight = self._weight.copy()
        weight[GEOMETRY, GEOMETRY] = 0.0
        error = self.known.position_jacobian()[0]
        shape = np.trace(self.known.covariance[GEOMETRY, GEOMETRY] @ self._weight[GEOMETRY, GEOMETRY])
        return weight, float(np.mean(np.sum(error**2, axis=1)) + shape)

    def _worth(self, places: Complex) -> Real:
        """(N,) benefit of a reading at each position."""
        rows = self.known.rows(places)
        if not self.trusted and self.known.memory is not None:
            test, changes = self._test
            information = self._information + rows[:, :, None] * rows[:, None, :]
            return np.asarray(np.log1p(test.noncentrality(information, changes)).mean(axis=1))
        return gains(self.known.covariance, rows, self._weight)

    @cached_property
    def _information(self) -> Real:
        """(P, P) information of the readings alone."""
        J = self.known.found.solution.jacobian
        return np.asarray(J.T @ J)

    @cached_property
    def _test(self) -> tuple[Contradiction, Real]:
        """Test of the memory, and the changes (D, M) that a full run would see."""
        test, names = memory_test(self.known)
        changes = changes_of(names, REMOUNT_MM, LINK_MM if self.known.measured_before else OTHER_TYPE_MM)
        full = self._rows_of_full
        seen = test.noncentrality(full.T @ full, changes) >= VISIBLE_SDS**2
        return test, changes[seen]


def memory_test(known: Known) -> tuple[Contradiction, tuple[str, ...]]:
    """The ability of readings of one mount to contradict the memory, and the memory.

    Only where there is a memory.
    """
    assert known.memory is not None
    names = [p.name for p in known.parameters]
    memory = known.memory.about(names)
    lasting = np.array([names.index(name) for name in memory.names])
    passing = np.array([k for k in range(len(names)) if k not in lasting])
    sd = np.array([known.parameters[k].prior_sd for k in passing])
    finite = np.where(np.isfinite(sd), sd, 1.0)
    information = np.where(np.isfinite(sd), 1.0 / finite**2, 0.0)
    return Contradiction(memory.covariance, lasting, passing, information, GATE_P), memory.names


def _positive(covariance: Real) -> Real:
    """The same without negative parts from rounding or an exchanged block."""
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray((vectors * np.maximum(values, 0.0)) @ vectors.T)


def adaptive_run(
    robot: Robot, remembered: Beforehand | None, wanted_mm: float | None, pace: Pace
) -> Procedure:
    """Reading by reading until there is a reason to stop."""
    age_days = remembered.age_days if remembered else 0.0
    memory = aged(remembered, robot, age_days).informed(robot)[0] if remembered else None
    aim = Aim.of(robot, wanted_mm, pace)
    known, here_deg, gate = Known(robot, memory=memory), np.degrees(HOME), None
    first = Situation(known, aim, here_deg).first_places()
    while True:
        number = len(known.readings) + 1
        now = Situation(known, aim, here_deg)
        stop = now.stop_at(first[number - 1] if number <= len(first) else now.next_place())
        readings: list[Reading] = yield MeasurementSequence(f"Measuring, reading {number}", 1, (stop,))
        known, here_deg = known.absorb(readings[0]), np.array(readings[0].theta_deg)
        try:
            stopped = Situation(known, aim, here_deg).stops_because()
            if known.memory is not None:
                gate = known.found.gate
                assert gate is not None
                if gate.p_value < (CONTRADICTED_P if stopped is None else GATE_P):
                    known, gate = known.without_memory(), replace(gate, used=False)
                    stopped = Situation(known, aim, here_deg).stops_because()
        except NotConvergedError as error:
            return not_identified(f"The readings do not determine the machine: {error}.")
        if stopped is not None:
            break
    result = _result(known, wanted_mm, stopped, Situation(known, aim, here_deg))
    return with_memory_use(result, gate, remembered, age_days)


def _result(known: Known, wanted_mm: float | None, stopped: Phrase, last: Situation) -> CalibrationResult:
    found, readings = known.found, list(known.readings)
    if impossible := found.mechanism.implausible(found.p):
        return without_jump(not_identified(f"Impossible result: {impossible}."), known.robot, readings)
    result = predicted_result(found, readings).model_copy(
        update={"lasting": found.lasting.record(), "advice": advice_of(found)}
    )
    result = without_jump(result, known.robot, readings)
    accuracy = accuracy_of(found, wanted_mm, stopped=stopped)
    return with_accuracy(result, accuracy, possible_mm=min(last.best_mm, last.bound_mm))


def fit_in_sequence(
    robot: Robot, readings: list[Reading], memory: Beforehand | None, age_days: float
) -> Identification[FiveBar]:
    """The fit of a finished run, repeated from its readings.

    :raises InputRefused: they do not determine the machine.
    """
    known = Known(
        robot, tuple(readings), aged(memory, robot, age_days).informed(robot)[0] if memory else None
    )
    try:
        return known.found
    except NotConvergedError as error:
        raise InputRefused(f"The readings do not determine the machine: {error}.") from error
