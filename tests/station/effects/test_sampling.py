"""What a grid of angles can tell, and sizes that physics excludes."""

from __future__ import annotations

import numpy as np
import pytest

from station.effects.backlash import Backlash
from station.effects.cyclic import fastest_seen
from station.effects.transmission_gain import TransmissionGain


def test_on_a_grid_a_ripple_is_seen_up_to_half_a_cycle_a_step() -> None:
    """At 10.6 degrees 1.25 and 32.75 cycles a turn are one: 360 / 10.6 = 33.96, half of it 16.98."""
    grid = np.radians(10.6 * np.array([0, 1, 2, 3, 5, 6, 8, 8, 2, 1]))
    assert fastest_seen(grid) == pytest.approx(16.98, abs=0.2)


def test_angles_that_were_not_set_up_by_hand_have_no_such_limit() -> None:
    assert fastest_seen(np.random.default_rng(1).uniform(-2.0, 2.0, 50)) == np.inf


def test_a_play_of_negative_width_and_a_gain_of_two_percent_are_no_causes() -> None:
    little = np.array([[1e-12]])
    assert Backlash(1).possible({}, np.array([-1e-4]), little)
    assert not Backlash(1).possible({}, np.array([1e-4]), little)
    assert not TransmissionGain(1).possible({}, np.array([-0.020959]), little)
