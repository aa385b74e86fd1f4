"""Advice: only what helps, best per minute first, and the gain that it predicts is the gain that comes."""

from __future__ import annotations

import numpy as np
import pytest

from station.five_bar import FiveBar, Robot
from station.identification import Identification, bounds_mm, identify
from station.identification.advice import advice_of
from station.plans import make_plan
from station.records import AnyReference, JointAngle, Measurements, MountingError
from station.studies.drawn import Drawn, drawn, robot_of

ROBOT = robot_of(0.03)


@pytest.fixture(scope="module")
def measured() -> tuple[Drawn, Measurements]:
    machine, _ = drawn(ROBOT, 6)
    return machine, machine.machine().measure(make_plan("full", ROBOT).stops)


def fit(robot: Robot, readings: Measurements) -> Identification[FiveBar]:
    return identify(robot, readings)


def test_it_is_ranked_and_names_only_what_helps(measured: tuple[Drawn, Measurements]) -> None:
    advice = advice_of(fit(ROBOT, measured[1]))
    rates = [one.gain_mm / one.minutes for one in advice]
    assert rates == sorted(rates, reverse=True)
    assert {one.kind for one in advice} >= {"joint_angle", "drm_x", "second_mount"}
    assert all(one.gain_mm > 0.0 for one in advice)
    assert not any("height" in one.text for one in advice)


@pytest.mark.parametrize("kind", ["joint_angle", "drm_x"])
def test_the_predicted_gain_comes(measured: tuple[Drawn, Measurements], kind: str) -> None:
    readings = measured[1]
    before = fit(ROBOT, readings)
    reference: AnyReference = JointAngle(
        joint=1, at_deg=0.0, reads_deg=float(np.degrees(before.dtheta[0])), sd_deg=0.005
    )
    if kind == "drm_x":
        reference = MountingError(kind="drm_x", value_mm=float(before.p[10]), sd_mm=0.02)
    after = fit(ROBOT.informed([reference]), readings)
    gain_mm = bounds_mm(before)[0] - bounds_mm(after)[0]
    predicted = next(one.gain_mm for one in advice_of(before) if one.kind == kind)
    assert predicted == pytest.approx(gain_mm, rel=0.1)


def test_what_has_been_done_is_not_advised_again(measured: tuple[Drawn, Measurements]) -> None:
    machine, readings = measured
    seen = JointAngle(joint=1, at_deg=0.0, reads_deg=float(np.degrees(machine.truth[0])), sd_deg=0.0005)
    advice = advice_of(fit(ROBOT.informed([seen]), readings))
    assert not any("joint 1" in one.text for one in advice)
