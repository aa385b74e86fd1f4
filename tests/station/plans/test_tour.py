"""Short ways: as short as can be found otherwise, every position once a sweep, time apart from position."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.five_bar import Robot
from station.plans import Pace, make_plan
from station.plans.duration import ARRIVAL_S, USUAL
from station.plans.tour import short_ways
from station.settings import LimitSettings

ROBOT = Robot.default()


def test_a_leg_lasts_as_long_as_the_joint_that_goes_further() -> None:
    pace = Pace(speed_deg_s=10.0, run_up_deg=0.5, reading_s=0.2)
    theta = np.array([[0.0, 180.0], [10.0, 185.0], [10.0, 185.0]])
    approach = np.array([[0, 0], [1, 1], [-1, 1]])
    travel, duration = pace.along(theta, approach)
    assert travel == pytest.approx([0.0, 10.0, 1.0])
    # the last one is approached from the other side: away by the run-up, and back
    assert duration == pytest.approx([ARRIVAL_S + 0.2, 1.0 + ARRIVAL_S + 0.2, 0.1 + 2 * ARRIVAL_S + 0.2])


def test_a_faster_station_is_faster() -> None:
    slow, fast = (Pace.of(LimitSettings(speed_deg_s=speed)) for speed in (15.0, 60.0))
    predicted = [make_plan("full", ROBOT, pace=pace).predicted for pace in (slow, fast)]
    assert predicted[0].travel_deg == predicted[1].travel_deg
    assert (predicted[0].duration_s or 0.0) > (predicted[1].duration_s or 0.0)


@pytest.mark.parametrize("plan", ["full", "diagnostic"])
def test_120_readings_take_less_than_50_s(plan: str) -> None:
    found = make_plan(plan, ROBOT)
    assert len(found.stops) == 120
    assert found.predicted.duration_s is not None
    assert found.predicted.duration_s <= 50.0
    assert 500.0 < (found.predicted.travel_deg or 0.0) < 700.0


def test_each_position_of_full_is_read_from_both_sides() -> None:
    stops = make_plan("full", ROBOT).stops
    for position in {stop.position for stop in stops}:
        sides = [stop.approach for stop in stops if stop.position == position]
        assert sorted(sides.count(side) for side in set(sides)) == [2, 3]
        first, second = set(sides)
        assert first == (-second[0], -second[1])


def test_each_sweep_of_full_visits_every_position_once() -> None:
    positions = [stop.position for stop in make_plan("full", ROBOT).stops]
    sweeps = [positions[k : k + 24] for k in range(0, 120, 24)]
    assert all(len(set(sweep)) == 24 for sweep in sweeps)
    assert len({tuple(sweep) for sweep in sweeps}) > 2


@pytest.mark.parametrize("plan", ["full", "diagnostic"])
def test_time_tells_little_of_position(plan: str) -> None:
    found = make_plan(plan, ROBOT)
    theta = np.array([stop.theta_deg for stop in found.stops])
    x, y = np.array([stop.target_mm for stop in found.stops]).T
    approach = np.array([stop.approach for stop in found.stops])
    time = np.cumsum(USUAL.along(theta, approach)[1])
    for column in (x, y, x * y, *approach.T):
        assert abs(np.corrcoef(time, column)[0, 1]) < 0.15


def test_ten_positions_of_diagnostic_are_repeated_from_one_side_at_different_times() -> None:
    stops = make_plan("diagnostic", ROBOT).stops
    repeated: dict[str, list[int]] = {}
    for number, stop in enumerate(stops):
        if stop.approach != (0, 0):
            repeated.setdefault(stop.position, []).append(number)
    assert len(repeated) == 10
    for position, numbers in repeated.items():
        assert len(numbers) == 3, position
        assert len({stops[number].approach for number in numbers}) == 1
    assert np.mean([max(numbers) - min(numbers) for numbers in repeated.values()]) > 60


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**31), st.integers(3, 9))
def test_a_short_way_is_not_made_shorter_by_turning_a_part_round(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    theta = rng.uniform(-30.0, 30.0, (count, 2))

    def length(way: np.ndarray) -> float:
        return float(np.abs(np.diff(theta[way], axis=0)).max(axis=1).sum())

    for way in short_ways(theta, 3, rng):
        assert sorted(way) == list(range(count))
        for i in range(count):
            for j in range(i + 1, count):
                turned = np.concatenate([way[:i], way[i : j + 1][::-1], way[j + 1 :]])
                assert length(turned) >= length(way) - 1e-9
