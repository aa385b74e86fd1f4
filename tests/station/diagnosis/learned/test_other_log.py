"""Effects of one log on another: the arm stands elsewhere, and goes where it has not been before."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.learned.model_file import model_document
from station.diagnosis.learned.other_log import transfer
from station.diagnosis.traced_loop import TracedDiagnosis, traced
from station.errors import InputRefused
from station.records import ModelDocument
from station.studies.arms.physics import UR_LIKE, SimulatedArm, random_arm, random_poses, shift, turn
from tests.station.serial_arm.test_closed_loop import harmonic_drive

GAP_DEG = (-40.0, 20.0)
"""Of joint 2: where the first log never was."""


@pytest.fixture(scope="module")
def arm() -> SimulatedArm:
    return random_arm(UR_LIKE, 9, j2=harmonic_drive)


@pytest.fixture(scope="module")
def learned(arm: SimulatedArm) -> TracedDiagnosis:
    theta = random_poses(6, 1200, 9)
    gap = (np.degrees(theta[:, 1]) > GAP_DEG[0]) & (np.degrees(theta[:, 1]) < GAP_DEG[1])
    return traced(arm.robot, arm.log(theta[~gap], 9))


@pytest.fixture(scope="module")
def part(learned: TracedDiagnosis) -> ModelDocument:
    assert [f.term.effect.label for f in learned.trace.findings] == ["gear_cyclic curve of joint 2"]
    return model_document(learned, learned.last, 1.0, stage="last", confirmed=None)


def elsewhere(arm: SimulatedArm) -> SimulatedArm:
    """The same arm in front of another wall, with another reflector."""
    return replace(
        arm,
        base=shift("x", 1500.0) @ shift("z", 300.0) @ turn("z", -0.4) @ turn("y", 0.05),
        tool=arm.tool + np.array([15.0, -10.0, 40.0]),
    )


def test_a_curve_holds_where_its_joint_has_been(arm: SimulatedArm, part: ModelDocument) -> None:
    other = elsewhere(arm).log(random_poses(6, 900, 10), 10)
    result = transfer(part, arm.robot, other, "first")
    assert result.effects == ("gear_cyclic curve of joint 2",)
    # three coordinates of 0.02 mm each
    assert result.applied.rms_mm < 0.05 < 3.0 * result.applied.rms_mm < result.alone.rms_mm
    in_gap = (np.degrees(other.theta[:, 1]) > GAP_DEG[0]) & (np.degrees(other.theta[:, 1]) < GAP_DEG[1])
    assert result.inside == pytest.approx((~in_gap).sum(), rel=0.05)


def test_in_a_gap_the_curve_is_not_applied(arm: SimulatedArm, part: ModelDocument) -> None:
    other = elsewhere(arm).log(random_poses(6, 900, 11), 11)
    result = transfer(part, arm.robot, other, "first")
    assert result.beyond is not None
    alone, applied = result.beyond
    # better for what is known of the others, and no worse than nothing in the gap
    assert applied.rms_mm < 0.8 * alone.rms_mm
    assert applied.max_mm < 1.3 * alone.max_mm


def test_where_nothing_was_learned_nothing_is_judged(arm: SimulatedArm, part: ModelDocument) -> None:
    theta = random_poses(6, 400, 12)
    theta[:, 1] = np.radians(np.random.default_rng(1).uniform(*GAP_DEG, 400))
    with pytest.raises(InputRefused, match="readings are in the joint ranges of the learned effects"):
        transfer(part, arm.robot, arm.log(theta, 12), "first")
