"""Fresh readings against a frozen model: only what predicts them may be called the cause."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.model import Fit, Model
from station.kinematics import Real
from station.measurements import Measurements
from station.mechanism import by_reading

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
    """(R,) measured less predicted."""
    sd_mm: Real
    """(R,) of that, by the model's covariance and the noise."""
    error_mm: Real
    """(K,) size of each reading's residual."""
    p_value: float
    left_out: tuple[int | str, ...]
    """Ids of few fresh readings far off a model that predicts all others; they took no part in p_value."""

    @property
    def confirmed(self) -> bool:
        return bool(self.p_value >= REFUSED_P)

    @property
    def rms_mm(self) -> float:
        return float(np.sqrt(np.mean(self.error_mm**2)))

    @property
    def max_mm(self) -> float:
        return float(self.error_mm.max())


def confirm(learned: Fit, fresh: Measurements, noise_dof: int) -> Confirmation:
    """Predict fresh readings with everything frozen.

    The statistic is chi-square with the prediction covariance; as the noise itself was estimated
    with `noise_dof` degrees of freedom it is held against F.
    """
    model = Model(learned.model.mechanism.of(fresh), learned.model.reference, learned.model.terms)
    base = learned.x[: model.base_size]
    bases = model.bases(model.conditions(base, first=False))
    at = model.observe(learned.x, bases)
    mechanism = model.mechanism
    residual = mechanism.measured - at.value
    ratio = float(np.sqrt(np.mean(learned.row_sd**2) / np.mean(learned.model.mechanism.row_sd**2)))
    noise = mechanism.row_sd * ratio
    J, C = at.by_parameter, learned.solution.covariance
    sd = np.sqrt(np.einsum("ki,ki->k", J @ C, J) + noise**2)
    off = np.zeros(len(fresh), dtype=bool)
    off[mechanism.reading_of_row[np.abs(residual) > FAR_OFF * sd]] = True
    if off.sum() > max(1, int(FEW_OFF * len(fresh))):
        off[:] = False
    kept = ~off[mechanism.reading_of_row]
    square = _chi_square(residual[kept] / noise[kept], J[kept] / noise[kept, None], C)
    few = int(kept.sum())
    p_value = float(fdtrc(few, max(noise_dof, 1), square / few))
    left_out = tuple(np.array(fresh.ids, dtype=object)[off])
    return Confirmation(residual, sd, by_reading(mechanism, residual), p_value, left_out)


def _chi_square(r: Real, J: Real, C: Real) -> float:
    """r' (1 + J C J')^-1 r, by Woodbury's identity with matrices no larger than C (P, P)."""
    along = J.T @ r
    return float(r @ r - along @ np.linalg.solve(np.eye(len(C)) + C @ (J.T @ J), C @ along))
