"""The leave-block-out identity against refits without each place."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.tests_of_fit.cross_validation import held_out, without_a_quarter
from station.diagnosis.traced_loop import traced
from station.five_bar.mechanism import FiveBar
from station.mechanism.conditions import reference_of
from station.model.model import Fit, Model, fit
from station.records import Flags, Real
from station.studies.arms.physics import UR_LIKE, random_arm, random_poses
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


def shares(theta_of_row: list[int]) -> tuple[list[int], int]:
    """Positions put aside of an arm's log that visits these positions in turn, and the number of readings."""
    arm = random_arm(UR_LIKE, 1)
    poses = random_poses(6, max(theta_of_row) + 1, 1)
    log = replace(arm.log(poses[theta_of_row]), position=np.array(theta_of_row))
    learned, aside = without_a_quarter(log)
    assert not set(learned.position) & set(aside.position)
    return sorted(set(aside.position.tolist())), len(aside)


def test_different_poses_are_put_aside_in_blocks_of_neighbours() -> None:
    # 320 readings: eight blocks of forty, every fourth from the first
    assert shares(list(range(320))) == ([*range(40), *range(160, 200)], 80)


def test_poses_that_are_visited_again_count_with_all_their_visits() -> None:
    """14 poses, each visited three times in an order of its own: 42 readings in blocks of five."""
    # readings before the first visit of pose k: 3 k; blocks 0 0 1 1 2 3 3 4 4 5 6 6 7 7
    again = [*range(14), *range(14), *reversed(range(14))]
    assert shares(again) == ([0, 1, 7, 8], 12)


def test_a_home_pose_between_all_others_is_learned_from() -> None:
    home_between = [pose for k in range(1, 21) for pose in (0, k)]
    aside, count = shares(home_between)
    assert 0 not in aside
    assert count == 5
