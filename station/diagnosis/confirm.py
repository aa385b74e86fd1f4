"""Fresh readings against a frozen model: only what predicts them may be called the cause."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.model import Fit, Model
from station.five_bar import FiveBar
from station.kinematics import Real
from station.measurements import Measurements

REFUSED_P = 0.005
"""A true model is refused this often."""
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
    """Ids of few fresh readings far off a model that predicts all others; they took no part in p_value."""

    @property
    def confirmed(self) -> bool:
        return bool(self.p_value >= REFUSED_P)

    @property
    def rms_mm(self) -> float:
        return float(np.sqrt(np.mean(self.residual_mm**2)))

    @property
    def max_mm(self) -> float:
        return float(np.abs(self.residual_mm).max())


def confirm(learned: Fit, fresh: Measurements, noise_dof: int) -> Confirmation:
    """Predict fresh readings with everything frozen.

    The statistic is chi-square with the prediction covariance; as the noise itself was estimated
    with `noise_dof` degrees of freedom it is held against F.
    """
    model = Model(FiveBar(learned.model.mechanism.robot, fresh), learned.model.reference, learned.model.terms)
    base = learned.x[: model.base_size]
    bases = model.bases(model.conditions(base, first=False))
    at = model.observe(learned.x, bases)
    residual = fresh.distance - at.value
    ratio = float(np.sqrt(np.mean(learned.row_sd**2) / np.mean(learned.model.mechanism.row_sd**2)))
    noise = model.mechanism.row_sd * ratio
    J, C = at.by_parameter, learned.solution.covariance
    covariance = J @ C @ J.T + np.diag(noise**2)
    sd = np.sqrt(np.diag(covariance))
    kept = np.ones(len(residual), dtype=bool)
    off = np.abs(residual) > FAR_OFF * sd
    if 0 < off.sum() <= max(1, int(FEW_OFF * len(residual))):
        kept = ~off
    few = residual[kept]
    square = float(few @ np.linalg.solve(covariance[np.ix_(kept, kept)], few))
    p_value = float(fdtrc(len(few), max(noise_dof, 1), square / len(few)))
    return Confirmation(residual, sd, p_value, tuple(np.array(fresh.ids, dtype=object)[~kept]))
