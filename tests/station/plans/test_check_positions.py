"""The test behind plan `check`: false alarms as stated, the smallest shift found as stated."""

from __future__ import annotations

import numpy as np
import pytest

from station.plans import REST_P, SHIFT_P, ShiftTest

ROWS = np.array([[3.0, 1.0], [-1.0, 2.0], [2.0, -2.0], [-4.0, -1.0]])
PREDICTED = np.diag([1.3, 1.6, 1.1, 2.0])
OFFSET_OPEN = 1e8 * np.ones((4, 4))
DRAWS = 2000


def shares(dof: int, shift: float) -> tuple[float, float]:
    """Refused without a shift; found with so many times the smallest shift of joint 1."""
    rng = np.random.default_rng(4)
    test = ShiftTest(ROWS, PREDICTED + OFFSET_OPEN, dof)
    off = ROWS[:, 0] * test.smallest()[0] * shift
    noise = rng.standard_normal((DRAWS, 4)) @ np.linalg.cholesky(PREDICTED).T
    told = np.sqrt(rng.chisquare(dof, DRAWS) / dof) if dof else np.ones(DRAWS)
    still = [test.shift(one / sd)[1:] for one, sd in zip(noise, told, strict=True)]
    moved = [test.shift((one + off) / sd)[1] for one, sd in zip(noise, told, strict=True)]
    refused = np.array(still) < [SHIFT_P, REST_P]
    return float(refused.any(axis=1).mean()), float(np.mean(np.array(moved) < SHIFT_P))


@pytest.mark.parametrize("dof", [0, 12])
def test_false_alarms_and_the_smallest_shift_are_as_stated(dof: int) -> None:
    false_alarms, found = shares(dof, 1.0)
    assert false_alarms == pytest.approx(SHIFT_P + REST_P, abs=0.006)
    assert found == pytest.approx(0.99, abs=0.008)


def test_what_few_repeats_tell_of_the_noise_makes_the_smallest_shift_larger() -> None:
    smallest = [ShiftTest(ROWS, PREDICTED + OFFSET_OPEN, dof).smallest()[0] for dof in (0, 72, 12)]
    assert smallest == sorted(smallest)
    assert smallest[1] == pytest.approx(1.04 * smallest[0], rel=0.01)
