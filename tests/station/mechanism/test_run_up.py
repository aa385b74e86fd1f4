"""A joint whose way is too short to take up its play makes a run-up."""

from __future__ import annotations

import numpy as np
import pytest

from station.five_bar import Robot
from station.mechanism import last_senses, needs_run_up
from station.records import Stop
from station.studies.simulation import SimulatedMachine

RUN_UP_DEG = 0.5


@pytest.mark.parametrize(
    ("wanted", "way_deg", "senses", "run_up"),
    [
        ((0, 0), (20.0, -30.0), (1, -1), False),
        ((0, 0), (20.0, 0.009), (1, 1), True),  # joint 2 still rests on the other side of its play
        ((0, 0), (-0.2, 30.0), (-1, 1), True),
        ((0, 0), (0.002, -0.003), (0, 0), False),  # a reading again where the arm stands
        ((0, 0), (0.002, 30.0), (0, 1), False),
        ((1, -1), (20.0, -30.0), (1, -1), False),
        ((-1, -1), (20.0, -30.0), (-1, -1), True),
        ((1, 1), (0.3, 30.0), (1, 1), True),
        ((1, 0), (0.0, 30.0), (1, 1), True),
    ],
)
def test_last_senses_and_run_up(
    wanted: tuple[int, int], way_deg: tuple[float, float], senses: tuple[int, int], run_up: bool
) -> None:
    found = last_senses(np.array(wanted), np.array(way_deg))
    assert tuple(found) == senses
    assert needs_run_up(found, np.array(way_deg), RUN_UP_DEG) == run_up


def test_many_at_once() -> None:
    way = np.array([[20.0, 0.009], [20.0, 30.0]])
    assert list(needs_run_up(last_senses(np.zeros((2, 2)), way), way, RUN_UP_DEG)) == [True, False]


def test_a_reading_after_a_short_way_stands_on_the_side_that_it_records() -> None:
    """A play of 0.05 degrees is worth 0.1 mm: joint 2 comes from above, then moves by 0.009 degrees."""
    play = {"kind": "backlash", "joint": 2, "width_deg": 0.05}
    machine = SimulatedMachine(Robot.default(), np.zeros(12), "exact", 1, [play], noise=False)
    near, target = (-7.0, 190.0), (20.0, 190.009)
    stops = [
        Stop("a", (0.0, 0.0), near, (-1, -1)),
        Stop("b", (0.0, 0.0), target),
        Stop("b", (0.0, 0.0), target, (1, 1)),
        Stop("b", (0.0, 0.0), target, (1, -1)),
    ]
    _, free, above, below = machine.run(stops).distance
    assert free == pytest.approx(above, abs=1e-6)
    assert abs(below - above) > 0.05
