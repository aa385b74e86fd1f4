"""How often an experiment decides: by hand, where it cannot, and where it must."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import norm

from station.diagnosis.experiments.outcomes import Outcome, decides


def reading(mean: float, known_sd: float, noise_sd: float = 1.0) -> Outcome:
    return Outcome(np.array([mean]), np.array([[known_sd]]), np.array([noise_sd**2]))


def test_two_explanations_that_say_the_same_are_never_decided() -> None:
    assert decides([reading(1.0, 0.5), reading(1.0, 0.5)], [0.5, 0.5]) == 0.0


def test_far_apart_one_reading_decides() -> None:
    assert decides([reading(0.0, 0.5), reading(20.0, 0.5)], [0.6, 0.4]) == 1.0


def test_one_reading_by_hand() -> None:
    """At even odds d sigma apart the likelihood ratio passes 19 where x is beyond d/2 + ln(19)/d."""
    d = 3.0
    edge = 0.5 * d + np.log(19.0) / d
    expected = norm.sf(edge - d) + norm.sf(edge)
    found = decides([reading(0.0, 0.0), reading(d, 0.0)], [0.5, 0.5], seed=3)
    assert found == pytest.approx(expected, abs=0.08)


def test_what_an_explanation_leaves_open_counts_like_noise() -> None:
    sure = decides([reading(0.0, 0.0), reading(6.0, 0.0)], [0.5, 0.5])
    unsure = decides([reading(0.0, 6.0), reading(6.0, 6.0)], [0.5, 0.5])
    assert unsure < 0.2 < 0.8 < sure


def test_a_reading_taken_twice_has_noise_of_its_own() -> None:
    twice = reading(0.0, 2.0).take([0, 0])
    assert np.allclose(twice.covariance, [[5.0, 4.0], [4.0, 5.0]])
