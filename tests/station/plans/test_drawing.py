"""A plan is drawn where people look: in the terminal and as a page."""

from __future__ import annotations

import pytest

from station.five_bar.robot_file import Robot
from station.plans import make_plan
from station.plans.drawing import plan_as_text, plan_page

ROBOT = Robot.default()


def test_the_terminal_shows_each_place_with_its_readings() -> None:
    drawn = plan_as_text(make_plan("paper", ROBOT), ROBOT)
    top, bottom = drawn.splitlines()[1], drawn.splitlines()[-3]
    assert [top[1], top[31], top[61]] == ["1", "1", "1"]
    assert [bottom[1], bottom[31], bottom[61]] == ["1", "1", "1"]
    assert sum(c == "1" for row in drawn.splitlines()[1:-2] for c in row[:63]) == 6


def test_the_page_needs_nothing_from_outside() -> None:
    page = plan_page(make_plan("full", ROBOT)).to_html()
    assert "<svg" in page
    assert "http://" not in page.replace("http://www.w3.org", "")
    assert "https://" not in page


def test_predicted_error_is_mapped_over_the_workspace() -> None:
    predicted = make_plan("rapid", ROBOT).predicted
    spread = [p.sd_mm for p in predicted.map]
    assert max(spread) == pytest.approx(predicted.position_error_mm.max)
