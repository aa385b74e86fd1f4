"""Taught positions under new zeros: where they stand, how sure that is, what is marked and refused."""

from __future__ import annotations

import numpy as np
import pytest

from station.errors import InputRefused
from station.five_bar import inverse
from station.identification import identify, zero_difference
from station.plans import make_plan
from station.records import JointAngle, TaughtPosition, read_taught_file, translated_to_csv
from station.run_kinds.translate import Change, translated
from station.settings import DEFAULT_JOINTS
from station.studies.drawn import drawn, robot_of
from station.studies.simulation import true_positions

ROBOT = robot_of(0.03)
STOPS = make_plan("rapid", ROBOT).stops


def taught(count: int, rng: np.random.Generator) -> tuple[TaughtPosition, ...]:
    places = rng.uniform(-230, 230, count) + 1j * rng.uniform(-775, -640, count)
    degrees = np.degrees(inverse(ROBOT.geometry, places))
    return tuple(
        TaughtPosition(position=f"P{k}", theta1_deg=float(a), theta2_deg=float(b))
        for k, (a, b) in enumerate(degrees)
    )


def test_a_frame_that_moved_is_exact() -> None:
    rng = np.random.default_rng(1)
    truth = np.zeros(12)
    truth[:2] = np.radians([1.5, -0.8])
    moved = truth.copy()
    shift = np.radians([1.5, -0.8])
    moved[:2] -= shift
    positions = taught(20, rng)
    new = translated(Change(ROBOT, shift, np.eye(2) * 1e-12), positions, DEFAULT_JOINTS)
    old_theta = np.radians([[p.theta1_deg, p.theta2_deg] for p in positions])
    new_theta = np.radians([[p.theta1_deg, p.theta2_deg] for p in new])
    off = np.abs(true_positions(ROBOT, truth, old_theta) - true_positions(ROBOT, moved, new_theta))
    assert off.max() < 1e-9
    assert all(p.u95_mm is not None and p.u95_mm < 0.01 for p in new)


def test_after_a_collision_and_two_calibrations_they_stand_within_what_is_said() -> None:
    """Both calibrations were applied: what is left of each zero is its uncertainty."""
    held: list[bool] = []
    size: dict[bool, list[float]] = {True: [], False: []}
    for seed in range(24):
        machine, rng = drawn(ROBOT, seed)
        struck = machine.struck(rng)
        fits = []
        for number, one in enumerate((machine, struck)):
            seen_deg = float(np.degrees(one.truth[0]) + rng.normal(0.0, 0.005))
            reference = JointAngle(joint=1, at_deg=0.0, reads_deg=seen_deg, sd_deg=0.005)
            fits.append(identify(ROBOT.informed([reference]), one.machine(number).measure(STOPS)))
        moved, covariance = zero_difference(*fits, same_mounting=(same := seed % 2 == 0))
        change = Change(ROBOT, moved - fits[0].dtheta + fits[1].dtheta, covariance)
        positions = taught(10, rng)
        new = translated(change, positions, DEFAULT_JOINTS)
        old_theta = np.radians([[p.theta1_deg, p.theta2_deg] for p in positions])
        new_theta = np.radians([[p.theta1_deg, p.theta2_deg] for p in new])
        then = true_positions(ROBOT, machine.truth, old_theta - fits[0].dtheta)
        now = true_positions(ROBOT, struck.truth, new_theta - fits[1].dtheta)
        bound = np.array([p.u95_mm for p in new])
        held += list(np.abs(then - now) <= bound)
        size[same] += list(bound)
    assert np.mean(held) >= 0.94
    assert np.median(size[True]) < 0.5 * np.median(size[False]) < 0.1


def test_a_translation_is_taken_back() -> None:
    change = Change(ROBOT, np.radians([0.4, -0.2]), np.eye(2) * 1e-12)
    positions = taught(3, np.random.default_rng(2))
    there = [
        TaughtPosition(position=p.position, theta1_deg=p.theta1_deg, theta2_deg=p.theta2_deg)
        for p in translated(change, positions, DEFAULT_JOINTS)
    ]
    for old, back in zip(positions, translated(change.back(), there, DEFAULT_JOINTS), strict=True):
        assert (back.theta1_deg, back.theta2_deg) == pytest.approx((old.theta1_deg, old.theta2_deg))


def test_limits_and_singularities_are_marked() -> None:
    def within(x: float, y: float) -> bool:
        a, b = np.degrees(inverse(ROBOT.geometry, np.array([complex(x, y)])))[0]
        position = TaughtPosition(position="P", theta1_deg=float(a), theta2_deg=float(b))
        return translated(Change(ROBOT, np.zeros(2), np.eye(2) * 1e-8), [position], DEFAULT_JOINTS)[
            0
        ].within_limits

    assert within(0.0, -700.0)
    assert not within(0.0, -600.0)
    apart = TaughtPosition(position="P", theta1_deg=-80.0, theta2_deg=80.0)
    found = translated(Change(ROBOT, np.zeros(2), np.eye(2) * 1e-8), [apart], DEFAULT_JOINTS)[0]
    assert not found.within_limits


def test_a_file_of_positions_is_read_and_written() -> None:
    read, program = read_taught_file(
        "position,note,theta1_deg,theta2_deg\nA,x,1.5,178\nB,,2,177.5\n", "t.csv"
    )
    assert program is None
    assert [p.position for p in read] == ["A", "B"]
    text = translated_to_csv(translated(Change(ROBOT, np.zeros(2), np.eye(2) * 1e-8), read, DEFAULT_JOINTS))
    lines = text.splitlines()
    assert lines[0] == "position,theta1_deg,theta2_deg,u95_mm,within_limits"
    assert lines[1].startswith("A,1.500000,178.000000,")
    assert lines[1].endswith(",true")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("position,theta1_deg\nA,1\n", "column theta2_deg is missing"),
        ("position,theta1_deg,theta2_deg\nA,one,2\n", "row 1: column theta1_deg"),
        ("position,theta1_deg,theta2_deg\nA,nan,2\n", "row 1: column theta1_deg"),
        ("position,theta1_deg,theta2_deg\n", "no positions"),
    ],
)
def test_what_is_no_such_file_is_refused(text: str, words: str) -> None:
    with pytest.raises(InputRefused, match=words):
        read_taught_file(text, "t.csv")
