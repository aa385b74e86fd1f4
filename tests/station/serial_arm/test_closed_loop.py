"""The loop on simulated arms, whose effects act where they would in the machine."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from station.diagnosis.report.joint_curves import curves
from station.diagnosis.report.traced_findings import TracedFindings
from station.diagnosis.tests_of_fit.cross_validation import without_a_quarter
from station.diagnosis.traced_loop import traced
from station.errors import InputRefused
from station.identification import identify
from station.records import Real
from station.studies.arms.physics import CRAIG_SEVEN, UR_LIKE, random_arm, random_poses

COUNT = 900


def ripple(amplitude_deg: float, n: float) -> Any:
    return lambda theta: np.radians(amplitude_deg) * np.sin(n * theta + 0.4)


def harmonic_drive(theta: Real) -> Real:
    """Twelve waves of different sizes: a curve, not a ripple."""
    rng = np.random.default_rng(8)
    waves = [
        rng.normal(0.0, 1.0) * np.sin(n * theta + rng.uniform(0, 6))
        for n in (5, 8, 11, 14, 16, 17, 18, 20, 23, 26, 31, 34)
    ]
    return np.asarray(np.radians(0.006) * np.sum(waves, axis=0))


def found(data: dict[str, Any], seed: int, by_range: bool = False, **effects: Any) -> TracedFindings:
    arm = random_arm(data, seed, **effects)
    m = arm.log(random_poses(arm.robot.joints, COUNT, seed), seed)
    return TracedFindings(traced(arm.robot, *without_a_quarter(replace(m, tracker=None) if by_range else m)))


@pytest.mark.parametrize("data", [UR_LIKE, CRAIG_SEVEN], ids=["six joints", "seven joints"])
def test_a_clean_arm_is_adequate(data: dict[str, Any]) -> None:
    result = found(data, 1)
    assert (result.diagnosis.verdict, result.diagnosis.confirmed, result.effects) == ("adequate", True, ())


@pytest.mark.parametrize("by_range", [False, True], ids=["position", "range"])
@pytest.mark.parametrize(("joint", "n"), [(2, 20.0), (3, 47.0)])
def test_one_ripple_is_named_by_joint_and_cycles(joint: int, n: float, by_range: bool) -> None:
    result = found(UR_LIKE, 2, by_range, **{f"j{joint}": ripple(0.01, n)})
    assert (result.diagnosis.verdict, result.diagnosis.confirmed) == ("explained", True)
    (effect,) = result.effects
    assert (effect.label, effect.aliases) == (f"gear_cyclic of joint {joint}", ())
    sizes = {q.name: q for q in effect.parameters}
    assert sizes["per_rev"].value == pytest.approx(n, abs=0.05)
    assert sizes["amplitude_deg"].value == pytest.approx(0.01, abs=4.0 * sizes["amplitude_deg"].sd)
    assert sizes["amplitude_deg"].sd < 0.0006


def test_many_waves_become_a_curve_that_holds_where_the_joint_has_been() -> None:
    result = found(UR_LIKE, 3, j2=harmonic_drive)
    assert result.diagnosis.confirmed
    assert result.effects[0].label == "gear_cyclic curve of joint 2"
    assert all(q.sd > 0.0 for q in result.effects[0].parameters)
    base, last = result.stages[1], result.stages[-1]
    assert base.confirm_rms_mm is not None and last.confirm_rms_mm is not None
    assert last.confirm_rms_mm < 0.25 * base.confirm_rms_mm
    (curve,) = curves(result.diagnosis.last)
    angle = np.radians(curve.angle_deg)
    # that machine's curve acts on the commanded angle, ours on the angle with its zero offset
    true = harmonic_drive(angle - np.radians(result.parameters[1].value))
    slow = np.column_stack(
        [f(k * angle) for k in range(1, 4) for f in (np.cos, np.sin)] + [np.ones(len(angle))]
    )
    true = np.degrees(true - slow @ np.linalg.lstsq(slow, true, rcond=None)[0])
    inner = np.abs(curve.angle_deg) < 115.0
    off = (curve.value_deg - true)[inner] / curve.sd_deg[inner]
    assert np.mean(np.abs(off) < 2.0) > 0.85


def test_gross_readings_are_named_and_left_out() -> None:
    arm = random_arm(UR_LIKE, 4, j2=ripple(0.01, 20.0))
    m = arm.log(random_poses(6, COUNT, 4))
    assert m.tracker is not None
    tracker = m.tracker.copy()
    tracker[[100, 500]] += [[3.0, 0.0, 0.0], [0.0, -2.0, 1.0]]
    result = traced(arm.robot, replace(m, tracker=tracker))
    assert {o.reading for o in result.outliers} == {101, 501}
    assert [f.term.effect.label for f in result.trace.findings] == ["gear_cyclic of joint 2"]


def test_parameters_that_cannot_be_told_apart_are_named() -> None:
    """Parallel axes: where along them a link sits is anybody's guess; the sum alone shows."""
    tied = found(UR_LIKE, 5).weak_direction.blind
    names = {text.split()[0] for text in tied}
    assert len({"d2", "d3", "d4", "b4"} - names) == 1
    assert "dtheta6" in names or "base_rz" in names or any("dtheta1" in text for text in tied)


@pytest.mark.parametrize("by_range", [False, True], ids=["position", "range"])
def test_forty_poses_are_judged_and_nothing_is_claimed_of_a_clean_arm(by_range: bool) -> None:
    arm = random_arm(UR_LIKE, 11)
    m = arm.log(random_poses(6, 40, 11), 11)
    result = TracedFindings(
        traced(arm.robot, *without_a_quarter(replace(m, tracker=None) if by_range else m))
    )
    assert result.effects == ()
    assert result.stages[-1].confirm_rms_mm is not None


def test_a_log_at_one_position_cannot_be_divided() -> None:
    m = random_arm(UR_LIKE, 12).log(np.repeat(random_poses(6, 1, 12), 40, axis=0), 12)
    with pytest.raises(InputRefused, match="40 readings at 1 positions cannot be divided"):
        without_a_quarter(m)


def test_readings_that_an_effect_moves_are_no_reason_to_refuse_a_log() -> None:
    arm = random_arm(UR_LIKE, 7, j1=lambda theta: np.radians(0.0157) * np.sin(theta + 1.0))
    arm.noise_mm = 0.005
    fit = identify(arm.robot, arm.log(random_poses(6, 300, 7), 7))
    assert fit.outliers == ()
    assert not fit.adequate
    assert fit.sd_factor > 2.0


def test_one_gross_reading_of_a_short_log_is_named_though_a_plain_fit_bends_to_it() -> None:
    arm = random_arm(UR_LIKE, 31)
    arm.noise_mm = 0.005
    m = arm.log(random_poses(6, 50, 31, 60.0), 31)
    assert m.tracker is not None
    tracker = m.tracker.copy()
    tracker[18] += [12.0, -35.0, -14.0]
    result = traced(arm.robot, replace(m, tracker=tracker))
    assert [o.reading for o in result.outliers] == [19]
    assert result.trace.adequate


def test_the_error_predicted_on_a_path_is_that_of_the_stretches_left_out() -> None:
    """A pose between two others of the path is predicted too well; a stretch without readings is not."""
    ratios = []
    for seed in range(4):
        arm = random_arm(UR_LIKE, 40 + seed)
        t = np.arange(70.0)
        rates = np.random.default_rng(seed).uniform(0.05, 0.25, 6)
        poses = np.sin(np.outer(t, rates) + np.arange(6))
        result = TracedFindings(traced(arm.robot, *without_a_quarter(arm.log(poses, seed))))
        left_out = result.stages[-1].confirm_rms_mm
        assert left_out is not None
        ratios.append(result.position_errors[1].rms / left_out)
    assert 1 / 1.5 < np.exp(np.mean(np.log(ratios))) < 1.5


def test_an_effect_that_fresh_readings_do_not_support_is_not_reported() -> None:
    """The fresh readings come from a machine without the effect."""
    arm = random_arm(UR_LIKE, 51, j2=ripple(0.01, 20.0))
    learned = arm.log(random_poses(6, 110, 51), 51)
    arm.effects = {}
    result = TracedFindings(traced(arm.robot, learned, arm.log(random_poses(6, 40, 52), 52)))
    assert result.effects == ()
    assert result.decision.verdict == "unexplained"
