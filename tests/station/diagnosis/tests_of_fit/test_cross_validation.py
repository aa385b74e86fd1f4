"""The leave-block-out identity against refits without each place."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.tests_of_fit.cross_validation import held_out
from station.diagnosis.traced_loop import traced
from station.five_bar.mechanism import FiveBar
from station.mechanism.conditions import reference_of
from station.model.model import Fit, Model, fit
from station.records import Flags, Real
from tests.station.simulated import ROBOT, Drawn


def refitted(whole: Fit, left_out: Flags) -> Real:
    """(B,) mm, readings left_out (mask) less what a fit to all others predicts of them."""
    m = whole.model.mechanism.measurements
    others = Model(FiveBar(ROBOT, m.take(~left_out)), reference_of(m), whole.model.terms)
    size = whole.model.base_size
    prior = replace(whole.prior, mean=whole.prior.mean[:size], root=whole.prior.root[:, :size])
    again = fit(others, prior, whole.row_sd[~left_out])
    bases = whole.model.bases(whole.model.conditions(again.x[:size]))
    return np.asarray((m.distance - whole.model.observe(again.x, bases).value)[left_out])


@pytest.mark.parametrize("stage", [0, 1], ids=["base", "with the effect"])
def test_hat_matrix_gives_what_refits_give(stage: int) -> None:
    sequence = Drawn({"kind": "backlash", "joint": 1, "width_deg": 0.01}, seed=1).sequence()
    whole = traced(ROBOT, sequence).trace.stages[stage].fit
    position = whole.model.mechanism.measurements.position
    by_identity = held_out(whole.solution, position) * whole.row_sd
    plain = whole.residual_mm
    for place in (0, 3, 9, 12, 30, 54):
        own = position == place
        brute = refitted(whole, own)
        assert np.abs(by_identity[own] - brute).max() < 0.02e-3
    # the correction is larger than what the identity may be off by
    assert np.abs(by_identity - plain).max() > 0.2e-3


def test_mean_of_numbers_by_hand() -> None:
    """One unknown, the mean of four numbers in two blocks: each block is predicted by the other's mean."""
    from station.fitting.least_squares import Prior, solve

    y = np.array([1.0, 3.0, 7.0, 9.0])
    solution = solve(lambda x: (x[0] - y, np.ones((4, 1))), np.zeros(1), Prior(np.zeros(1), np.zeros((0, 1))))
    assert held_out(solution, np.array([0, 0, 1, 1])) == pytest.approx([-7.0, -5.0, 5.0, 7.0])
