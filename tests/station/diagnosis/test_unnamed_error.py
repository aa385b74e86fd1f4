"""A smooth error of the pose that no entry of the catalogue describes."""

from __future__ import annotations

import numpy as np

from station.diagnosis.unnamed_error import left_by, unnamed_error
from station.fitting import tolerance_prior
from station.machines import mechanism_of
from station.mechanism import reference_of
from station.model import Fit, Model, fit
from station.records import Measurements
from station.studies.arms.physics import UR_LIKE, random_arm, random_poses


def fitted(m: Measurements) -> Fit:
    mechanism = mechanism_of(random_arm(UR_LIKE, 5).robot, m)
    return fit(Model(mechanism, reference_of(m)), tolerance_prior(mechanism), mechanism.row_sd)


def log(seed: int, size_mm: float) -> Measurements:
    """Two thirds of the poses of a narrow range; the target is off by a bump in two joints at once."""
    theta = random_poses(6, 240, seed, reach_deg=25.0)
    m = random_arm(UR_LIKE, 5).log(theta, seed)
    assert m.tracker is not None
    m.tracker[:, 2] += size_mm * np.exp(-(theta[:, 0] ** 2 + theta[:, 1] ** 2) / 0.05)
    return m


def test_it_is_learned_where_poses_were_read_and_goes_to_zero_elsewhere() -> None:
    last = fitted(log(1, 1.0))
    found = unnamed_error(last)
    assert found is not None
    fresh = log(2, 1.0)
    mechanism = last.model.mechanism.of(fresh)
    rows = mechanism.measured - mechanism.observe(last.x, mechanism.theta).value
    before = np.linalg.norm(rows.reshape(len(fresh), -1), axis=1)
    assert np.mean(left_by(found, fresh, rows) ** 2) < 0.5 * np.mean(before**2)
    assert np.abs(found.at(np.full((1, 6), 40.0))).max() < 1e-6


def test_noise_alone_has_none() -> None:
    assert unnamed_error(fitted(log(3, 0.0))) is None
