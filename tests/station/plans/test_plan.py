"""The register of plans, and what every plan promises."""

from __future__ import annotations

import pytest

from station.five_bar import Robot
from station.plans import PLANS, PlanDesign, make_plan, register
from station.plans.boundary import on_the_boundary
from station.run_kinds import RUN_KINDS, kind_of_plan

ROBOT = Robot.default()


def test_plans_are_offered_in_this_order() -> None:
    assert list(PLANS)[:4] == ["paper", "rapid", "full", "diagnostic"]


def test_a_name_is_taken_once() -> None:
    with pytest.raises(ValueError, match="registered already"):
        register(PlanDesign("full", on_the_boundary))


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
