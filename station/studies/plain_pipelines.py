"""What plain pipelines make of an arm's log: general methods on top of a kinematic fit, no search for causes.

Each learns from the readings that the loop learned from and is judged by those that judged the loop.  The
residual of the kinematic fit is predicted by
- a Gaussian process over the joint angles, its covariance by marginal likelihood,
- boosted trees over the joint angles, one ensemble a coordinate,
- curves of the joints: a Fourier series each, acting through the arm's derivatives, by ridge regression whose
  penalty is chosen by cross-validation,
- the curves, and a Gaussian process on what they leave.
"""

from __future__ import annotations

import warnings
from importlib.util import find_spec

import numpy as np

from station.diagnosis import TracedDiagnosis
from station.mechanism import by_reading
from station.records import Flags, Measurements, Real

HARMONICS = 40
PENALTIES = np.logspace(-4.0, 4.0, 17)
"""Relative to the mean square of the columns."""
FOR_THE_COVARIANCE = 400
"""Readings, evenly spread, by which the covariance is chosen: its time grows with their cube."""


def pipelines(d: TracedDiagnosis, kept: Flags) -> dict[str, float]:
    """RMS in mm of the fresh readings `kept` (F,), by name; none without scikit-learn (extra `studies`)."""
    if d.fresh is None or find_spec("sklearn") is None:
        return {}
    learned, fresh = d.measurements, d.fresh.take(kept)
    left, J = _residual(d, learned)
    left_fresh, J_fresh = _residual(d, fresh)
    coordinates = len(left) // len(learned)
    curves_at, curves_fresh = _curves(learned.theta, left, J, fresh.theta, J_fresh, coordinates)
    gp = _gaussian_process(learned.theta, left.reshape(-1, coordinates), fresh.theta)
    trees = _boosted_trees(learned.theta, left.reshape(-1, coordinates), fresh.theta)
    both = curves_fresh + _gaussian_process(
        learned.theta, (left - curves_at).reshape(-1, coordinates), fresh.theta
    )
    predictions = {
        "DH fit": np.zeros_like(left_fresh),
        "+ Gaussian process": gp,
        "+ boosted trees": trees,
        "+ joint curves": curves_fresh,
        "+ curves and process": both,
    }
    mechanism = d.base.model.mechanism.of(fresh)
    return {
        name: float(np.sqrt(np.mean(by_reading(mechanism, left_fresh - predicted) ** 2)))
        for name, predicted in predictions.items()
    }


def _residual(d: TracedDiagnosis, m: Measurements) -> tuple[Real, Real]:
    """(R,) measured less predicted by the kinematic fit, and its derivatives by the joints (R, n)."""
    mechanism = d.base.model.mechanism.of(m)
    at = mechanism.observe(d.base.x[: d.base.model.base_size], m.theta)
    return mechanism.measured - at.value, at.by_joint


def _gaussian_process(theta: Real, left: Real, at: Real) -> Real:
    """(L c,)"""
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    scale = float(left.std()) or 1.0
    start = ConstantKernel(1.0) * RBF(np.ones(theta.shape[1]), (1e-2, 1e3)) + WhiteKernel(0.5)
    some = slice(None, None, -(-len(theta) // FOR_THE_COVARIANCE))
    with warnings.catch_warnings():
        # the length of a joint that plays no part grows to its bound
        warnings.simplefilter("ignore", ConvergenceWarning)
        chosen = GaussianProcessRegressor(start).fit(theta[some], left[some] / scale).kernel_
    process = GaussianProcessRegressor(chosen, optimizer=None).fit(theta, left / scale)
    return np.asarray(process.predict(at)).reshape(-1) * scale


def _boosted_trees(theta: Real, left: Real, at: Real) -> Real:
    """(L c,)"""
    from sklearn.ensemble import HistGradientBoostingRegressor

    columns = [HistGradientBoostingRegressor(random_state=0).fit(theta, own).predict(at) for own in left.T]
    return np.column_stack(columns).reshape(-1)


def _curves(theta: Real, left: Real, J: Real, at: Real, J_at: Real, coordinates: int) -> tuple[Real, Real]:
    """(K c,) where they were learned and (L c,) elsewhere."""
    from sklearn.linear_model import RidgeCV

    known, there = _fourier(theta, J, coordinates), _fourier(at, J_at, coordinates)
    scale = np.sqrt(np.mean(known**2))
    ridge = RidgeCV(alphas=PENALTIES * len(known) * 1e-2, fit_intercept=False, cv=4)
    ridge.fit(known / scale, left)
    return np.asarray(ridge.predict(known / scale)), np.asarray(ridge.predict(there / scale))


def _fourier(theta: Real, J: Real, coordinates: int) -> Real:
    """(R, 2 n HARMONICS)"""
    reading = np.repeat(np.arange(len(theta)), coordinates)
    order = np.arange(1, HARMONICS + 1)
    waves = theta[:, :, None] * order
    basis = np.concatenate([np.cos(waves), np.sin(waves)], axis=2)[reading]
    return np.asarray((J[:, :, None] * basis).reshape(len(J), -1))
