"""Fresh readings against a frozen model: only what predicts them may be called the cause.

Two questions are put to them.  Are they predicted as a whole (chi-square with the prediction
covariance)?  And does nothing that a nameless smooth departure could describe show in old and fresh
readings together (`departures`)?  The second asks far more of a model, since it knows where to look.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.departures import Departure, Readings, Rest, of_fit, readings
from station.diagnosis.model import Fit, Model
from station.five_bar import FiveBar
from station.kinematics import Real
from station.measurements import Measurements

REFUSED_P = 0.001
"""A true model is refused this often as a whole,"""
DIRECTED_P = 1e-4
"""and this often by each of the directed tests."""
DOUBTED_P = 0.05
"""A departure no more significant than this still counts"""
DOUBTED_SHARE = 0.05
"""where it is as large as this share of what the effects took: so small an effect must be beyond doubt."""
FEWEST = 8
FAR_OFF = 5.0
"""Standard deviations; and of few fresh readings, at most this share:"""
FEW_OFF = 0.05


@dataclass(frozen=True)
class Confirmation:
    """What a frozen model made of fresh readings."""

    residual_mm: Real
    """(K,) measured less predicted."""
    sd_mm: Real
    """(K,) of that, by the model's covariance and the noise."""
    p_value: float
    left_out: tuple[int | str, ...]
    """Ids of few fresh readings far off a model that predicts all others; they took no part in the tests."""
    departures: tuple[Departure, ...]
    """Of readings learned on and fresh ones together."""
    unproven: bool
    """The effects took so little that a departure of no great significance may be their better name."""

    @property
    def confirmed(self) -> bool:
        departs = any(d.p_value < DIRECTED_P for d in self.departures)
        return bool(self.p_value >= REFUSED_P) and not departs and not self.unproven

    @property
    def rms_mm(self) -> float:
        return float(np.sqrt(np.mean(self.residual_mm**2)))

    @property
    def max_mm(self) -> float:
        return float(np.abs(self.residual_mm).max())


def confirm(base: Fit, learned: Fit, fresh: Measurements, noise_dof: int) -> Confirmation:
    """Predict fresh readings with everything frozen; `base` is the model before any effect was added.

    The statistic is chi-square with the prediction covariance, searched parameters included; as the
    noise itself was estimated with `noise_dof` degrees of freedom it is held against F.
    """
    model = Model(FiveBar(learned.model.mechanism.robot, fresh), learned.model.reference, learned.model.terms)
    ratio = float(np.sqrt(np.mean(learned.row_sd**2) / np.mean(learned.model.mechanism.row_sd**2)))
    noise = model.mechanism.row_sd * ratio
    conditions = model.conditions(learned.x[: model.base_size], first=False)
    before, after = of_fit(learned), readings(model, learned.x, fresh.distance, noise, conditions)
    residual, J = after.residual_mm, after.by_unknown
    covariance = J @ _covariance(learned, before) @ J.T + np.diag(noise**2)
    sd = np.sqrt(np.diag(covariance))
    kept = np.ones(len(residual), dtype=bool)
    off = np.abs(residual) > FAR_OFF * sd
    if 0 < off.sum() <= max(1, int(FEW_OFF * len(residual))):
        kept = ~off
    few = residual[kept]
    square = float(few @ np.linalg.solve(covariance[np.ix_(kept, kept)], few))
    departures = Rest((before, after.take(kept)), learned.prior, learned.x).departures()
    return Confirmation(
        residual_mm=residual,
        sd_mm=sd,
        p_value=float(fdtrc(len(few), max(noise_dof, 1), square / len(few))),
        left_out=tuple(np.array(fresh.ids, dtype=object)[~kept]),
        departures=departures,
        unproven=_unproven(base, learned, departures),
    )


def _covariance(learned: Fit, before: Readings) -> Real:
    """(X, X) of all unknowns, the searched ones included."""
    known = learned.solution.covariance
    if before.by_unknown.shape[1] == len(known):
        return known
    held = np.zeros((len(learned.prior.root), before.by_unknown.shape[1]))
    held[:, : len(known)] = learned.prior.root
    stacked = np.concatenate([before.by_unknown / before.row_sd[:, None], held])
    norms = np.linalg.norm(stacked, axis=0)
    norms[norms == 0.0] = 1.0
    inverse = np.linalg.pinv(stacked / norms)
    return np.asarray(inverse @ inverse.T / np.outer(norms, norms))


def _unproven(base: Fit, learned: Fit, departures: tuple[Departure, ...]) -> bool:
    """Squares count the tolerances too: geometry gives way to a smooth effect before the readings do."""
    if not learned.model.terms:
        return False
    took = base.cost * float(np.mean(base.row_sd**2) / np.mean(learned.row_sd**2)) - learned.cost
    return any(d.p_value < DOUBTED_P and d.share * learned.cost > DOUBTED_SHARE * took for d in departures)
