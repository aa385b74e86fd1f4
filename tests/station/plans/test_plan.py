"""The register of plans, and what every plan promises."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from station.errors import InputRefused
from station.five_bar import Robot
from station.plans import PLANS, PlanDesign, each_once, make_plan, register
from station.plans.boundary import on_the_boundary
from station.plans.duration import Pace
from station.run_kinds import RUN_KINDS, kind_of_plan
from station.studies.drawn import robot_of

ROBOT = Robot.default()


def test_plans_are_offered_in_this_order() -> None:
    assert list(PLANS)[:4] == ["paper", "rapid", "full", "diagnostic"]


def test_a_name_is_taken_once() -> None:
    with pytest.raises(ValueError, match="registered already"):
        register(PlanDesign("full", on_the_boundary))


@pytest.fixture
def far() -> Iterator[str]:
    """A plan with its second position 10 mm outside the workspace."""
    middle, x1 = sum(ROBOT.workspace_y) / 2, ROBOT.workspace_x[1]
    plan = PlanDesign("far", lambda robot: each_once(np.array([0j, x1 + 10.0]) + 1j * middle))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("station.plans.plan.PLANS", {**PLANS, "far": plan})
        yield "far"


def test_a_position_outside_the_workspace_is_named(far: str) -> None:
    with pytest.raises(InputRefused, match=r"P2 of the plan far, \(250\.0, -707\.0\) mm, lies outside"):
        make_plan(far, ROBOT)


@pytest.mark.parametrize("name", PLANS)
def test_a_plan_is_measured_by_a_kind_that_exists(name: str) -> None:
    assert name in RUN_KINDS[kind_of_plan(name)].plans


@pytest.mark.parametrize("name", PLANS)
def test_every_stop_lies_in_the_workspace(name: str) -> None:
    (x0, x1), (y0, y1) = ROBOT.workspace_x, ROBOT.workspace_y
    for stop in make_plan(name, ROBOT).stops:
        x, y = stop.target_mm
        assert x0 <= x <= x1
        assert y0 <= y <= y1


@pytest.mark.parametrize(("plan", "measured_mm"), [("reference", 0.182), ("two_mounts", 0.473)])
def test_what_a_person_contributes_is_predicted(plan: str, measured_mm: float) -> None:
    """Against the medians of the bounds of emulated machines, docs/accuracy.md."""
    predicted_mm = make_plan(plan, robot_of(0.03)).predicted.bound_95_mm
    assert predicted_mm == pytest.approx(measured_mm, rel=0.4)
    without_mm = make_plan("full", robot_of(0.03)).predicted.bound_95_mm
    assert predicted_mm < without_mm


def test_the_predicted_accuracy_counts_the_samples_of_a_reading() -> None:
    """The mean of more samples is less noisy, and takes longer; the positions stay."""
    few, many = (make_plan("paper", ROBOT, pace=Pace(30.0, 0.5, 0.1 * n, samples=n)) for n in (1, 100))
    assert few.stops == many.stops
    assert many.predicted.common_sd_deg < few.predicted.common_sd_deg
    assert many.predicted.position_error_mm.rms < few.predicted.position_error_mm.rms
    durations = [plan.predicted.duration_s or 0.0 for plan in (few, many)]
    assert 0.0 < durations[0] < durations[1]
