"""The study of random machines: what is counted as right, and what a cause found is worth."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from station.cli import main
from station.diagnosis.report.weighed_findings import WeighedFindings
from station.diagnosis.weighed_loop import weighed
from station.five_bar.robot_file import Robot
from station.studies.confusion.claims import judge
from station.studies.confusion.errors import before_and_after
from station.studies.confusion.machines import LARGEST_TIMES, draw, scaled

ROBOT = Robot.default()


@pytest.mark.parametrize("kind", ["backlash", "gear_cyclic", "compliance", "scale_gain"])
def test_a_cause_found_makes_readings_and_true_positions_better(kind: str) -> None:
    # of a size at which the cause, not the tolerances, decides where the platform stands
    drawn = next(d for d in (draw(ROBOT, (kind,), seed) for seed in range(12, 40)) if d.size_um[0] > 5.0)
    found = WeighedFindings(weighed(ROBOT, drawn.sequence, drawn.fresh))
    errors = before_and_after(ROBOT, drawn, found)
    assert judge(drawn, found).right
    assert errors.reading_um[1] < 1.4 < errors.reading_um[0]
    assert errors.position_um[1] < 0.5 * errors.position_um[0]


def test_a_machine_with_another_cause_is_not_right() -> None:
    drawn = draw(ROBOT, ("backlash",), 12)
    other = draw(ROBOT, ("scale_gain",), 12)
    found = WeighedFindings(weighed(ROBOT, other.sequence, other.fresh))
    assert not judge(drawn, found).right


def test_machines_of_several_kinds_make_a_page(tmp_path: Path) -> None:
    kinds = ["none", "scale_gain", "backlash+drift", "base_flex"]
    file = tmp_path / "page.md"
    arguments = ["confusion", "--machines", "1", "--markdown", str(file)]
    result = CliRunner().invoke(main, [*arguments, *(a for kind in kinds for a in ("--kind", kind))])
    assert result.exit_code == 0, result.output
    page = file.read_text(encoding="utf-8")
    assert page.count("| backlash+drift |") == 2
    assert "1 machines of each kind, seed 1" in page
    assert "| clean: no cause named | 1 of 1, 100.0 % |" in page


def test_no_machine_is_drawn_with_more_than_four_times_the_usual_size() -> None:
    tried: list[float] = []

    def left_um(amplitude: float) -> float:
        tried.append(amplitude)
        return 0.1 * amplitude

    assert scaled(left_um, 30.0) == LARGEST_TIMES
    assert max(tried) <= LARGEST_TIMES
