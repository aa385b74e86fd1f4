"""A joint that slips in the middle of a log of positions is named, with the moment or the reading."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis import TracedFindings, traced, without_a_quarter
from station.effects.count_slip import CountSlip
from station.errors import InputRefused
from station.mechanism import reference_of
from station.records import TIME, Flags, Measurements, Real, with_guesses
from station.serial_arm import SerialArm
from station.studies.arms.physics import UR_LIKE, SimulatedArm, random_arm, random_poses

COUNT = 120
SLIPPED_FROM = 73
"""Number of the first reading after the slip."""
STEP_DEG = 0.02


def slip(theta: Real) -> Real:
    return np.asarray(np.radians(STEP_DEG) * (np.arange(1, len(theta) + 1) >= SLIPPED_FROM))


def slipping() -> tuple[SimulatedArm, Measurements]:
    arm = random_arm(UR_LIKE, 7, j3=slip)
    return arm, arm.log(random_poses(6, COUNT, 7), 7)


def at_times(m: Measurements, t_s: Real) -> Measurements:
    return with_guesses(replace(m, t_s=t_s))


def found(arm: SimulatedArm, m: Measurements) -> dict[str, float]:
    result = TracedFindings(traced(arm.robot, *without_a_quarter(m)))
    (effect,) = result.effects
    assert (effect.label, result.decision.verdict, result.decision.confirmed) == (
        "count_slip of joint 3",
        "explained",
        True,
    )
    return {q.name: q.value for q in effect.parameters}


def test_a_slip_is_named_by_its_reading_where_the_time_counts_rows() -> None:
    arm, m = slipping()
    sizes = found(arm, m)
    assert sizes["step_deg"] == pytest.approx(STEP_DEG, abs=0.002)
    # the readings held out come in blocks of fifteen, and the reading before it may be one of them
    assert SLIPPED_FROM <= sizes["from_reading"] <= SLIPPED_FROM + 15


def test_a_slip_is_named_by_its_moment_where_there_are_times() -> None:
    arm, m = slipping()
    t_s = np.cumsum(np.random.default_rng(3).uniform(4.0, 7.0, COUNT))
    sizes = found(arm, at_times(m, t_s))
    assert t_s[SLIPPED_FROM - 1] <= sizes["from_s"] <= t_s[SLIPPED_FROM + 14]


def test_a_slip_learned_on_times_is_not_applied_to_row_numbers() -> None:
    arm, m = slipping()
    mechanism = SerialArm(arm.robot, m)
    c = mechanism.conditions(mechanism.start, reference_of(m), first=True)
    with pytest.raises(InputRefused, match="learned on a log with times; this log is without them"):
        CountSlip(3, timed=False).at({"from_s": 100.0}, c)


KEPT = np.arange(COUNT) % 9 != 4


@pytest.mark.parametrize(
    ("t_s", "counts"),
    [
        (np.arange(COUNT) + 1.0, True),
        (0.008 * np.arange(COUNT), True),
        (np.cumsum(np.random.default_rng(3).uniform(4.0, 7.0, COUNT)), False),
        (np.cumsum(np.random.default_rng(3).integers(4, 7, COUNT)).astype(float), False),
    ],
    ids=["numbers", "equal steps", "a clock", "a clock of full seconds"],
)
@pytest.mark.parametrize("kept", [np.ones(COUNT, dtype=bool), KEPT], ids=["every row", "rows left out"])
def test_numbers_of_rows_are_no_times(t_s: Real, counts: bool, kept: Flags) -> None:
    _, m = slipping()
    assert (TIME in at_times(replace(m, t_s=t_s).take(kept), t_s[kept]).guessed) is counts
