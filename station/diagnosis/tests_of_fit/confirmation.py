"""Fresh readings against a fixed model: only a model that predicts them may be called the cause.

There are three tests. Are they predicted as a whole (chi-square with the prediction covariance)? Do old and
fresh readings together show no smooth departure from the model (`departures`)? And are the effects a far
better explanation of all of them than an unnamed variation (`alternatives`)? The last two are far more
sensitive than the first, since they test specific directions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.tests_of_fit.alternatives import strongest
from station.diagnosis.tests_of_fit.smooth_departures import (
    Departure,
    Readings,
    WhitenedResidual,
    departures,
    of_fit,
    readings,
    whitened_residual,
)
from station.effects import doubtful
from station.fitting import BLIND, REFUSED_P, solved
from station.model import Fit, Model, is_long
from station.records import Flags, Measurements, Phrase, Real, phrase

DIRECTED_P = 1e-4
"""Probability that each directed test refuses a true model; `REFUSED_P` is that of the overall test."""
FEWEST = 8
FAR_OFF = 5.0
"""Standard deviations beyond which a fresh reading is far off; and the maximum share of such readings:"""
FEW_OFF = 0.05


@dataclass(frozen=True)
class Confirmation:
    """The comparison of a fixed model with fresh readings."""

    residual_mm: Real
    """(R,) measured less predicted."""
    sd_mm: Real
    """(R,) standard deviation of that, from the model's covariance and the noise."""
    error_mm: Real
    """(K,) size of each reading's residual."""
    p_value: float
    left_out: tuple[int | str, ...]
    """Ids of a few fresh readings far off a model that predicts all others; excluded from the tests."""
    whitened: WhitenedResidual
    """The model's residual for readings learned on and fresh ones; in a long log, only the former."""
    departures: tuple[Departure, ...]
    """Departures of it; in a long log no further ones are tested than `adequacy` has already."""
    alternative: str | None
    """An unnamed dependence that makes all readings about as probable as the effects do."""

    @property
    def confirmed(self) -> bool:
        return _predicted(self.p_value, self.departures) and self.alternative is None

    @property
    def refusal(self) -> Phrase:
        """What contradicts the model, where it is not refused because of an alternative."""
        if self.p_value < REFUSED_P or not self.departures:
            return phrase("refuted_by_fresh")
        worst = min(self.departures, key=lambda d: d.p_value)
        return phrase("still_depends", depends_on=worst.on)

    @property
    def rms_mm(self) -> float:
        return float(np.sqrt(np.mean(self.error_mm**2)))

    @property
    def max_mm(self) -> float:
        return float(self.error_mm.max())


def confirm(base: Fit, learned: Fit, fresh: Measurements, noise_dof: int) -> Confirmation:
    """Predict fresh readings with all parameters fixed; `base` is the model before any effect was added.

    The statistic is chi-square with the prediction covariance, searched parameters included; since the noise
    itself was estimated with `noise_dof` degrees of freedom, it is compared with F.
    """
    if is_long(learned.model.mechanism):
        return _of_long_log(learned, fresh, noise_dof)
    sd = learned.row_sd
    ratio = _noise_ratio(learned)
    before, after = of_fit(learned, sd), _fresh(learned, fresh, ratio)
    residual, J = after.residual_mm, after.by_unknown
    spread = J @ _root(learned, before)
    covariance = spread @ spread.T + np.diag(after.row_sd**2)
    sd_mm = np.sqrt(np.diag(covariance))
    off = _far_off(residual, sd_mm, after)
    kept = ~(off & doubtful((term.effect for term in learned.model.terms), after.conditions))
    if (off & kept).sum() <= max(1, int(FEW_OFF * len(fresh))):
        kept &= ~off
    rows = kept[after.reading]
    few = residual[rows]
    square = float(few @ solved(covariance[np.ix_(rows, rows)], few))
    p_value = float(fdtrc(len(few), max(noise_dof, 1), square / len(few)))
    whitened = WhitenedResidual((before, after.take(kept)), learned.prior, learned.x)
    found = departures(whitened)
    alternative = None
    if learned.model.terms and _predicted(p_value, found):
        without = WhitenedResidual(
            (of_fit(base, sd), _fresh(base, fresh, ratio).take(kept)), base.prior, base.x
        )
        alternative = strongest(without, whitened, learned.model.terms, learned.conditions)
    return Confirmation(
        residual, sd_mm, _sizes(after), p_value, _ids(fresh, ~kept), whitened, found, alternative
    )


def _of_long_log(learned: Fit, fresh: Measurements, noise_dof: int) -> Confirmation:
    """The first test only; thousands of readings show some smooth departure in any real machine."""
    after = _fresh(learned, fresh, _noise_ratio(learned))
    residual, C = after.residual_mm, learned.solution.covariance
    # with this many readings, searched parameters are known far better than fitted ones
    J = after.by_unknown[:, : len(C)]
    sd_mm = np.sqrt(np.einsum("ki,ki->k", J @ C, J) + after.row_sd**2)
    off = _far_off(residual, sd_mm, after)
    if off.sum() > max(1, int(FEW_OFF * len(fresh))):
        off[:] = False
    rows = ~off[after.reading]
    few = int(rows.sum())
    square = _chi_square(residual[rows] / after.row_sd[rows], J[rows] / after.row_sd[rows, None], C)
    p_value = float(fdtrc(few, max(noise_dof, 1), square / few))
    return Confirmation(
        residual, sd_mm, _sizes(after), p_value, _ids(fresh, off), whitened_residual(learned), (), None
    )


def _chi_square(r: Real, J: Real, C: Real) -> float:
    """r' (1 + J C J')^-1 r, by Woodbury's identity with matrices no larger than C (X, X)."""
    along = J.T @ r
    return float(r @ r - along @ solved(np.eye(len(C)) + C @ (J.T @ J), C @ along))


def _noise_ratio(learned: Fit) -> float:
    """Ratio of the learned noise to the specification."""
    return float(np.sqrt(np.mean(learned.row_sd**2) / np.mean(learned.model.mechanism.row_sd**2)))


def _far_off(residual: Real, sd: Real, of: Readings) -> Flags:
    """(K,) readings with a row further off than noise can be."""
    off = np.zeros(len(of.at), dtype=bool)
    off[of.reading[np.abs(residual) > FAR_OFF * sd]] = True
    return off


def _sizes(of: Readings) -> Real:
    """(K,) size of each reading's residual, mm."""
    return np.sqrt(np.bincount(of.reading, of.residual_mm**2))


def _ids(fresh: Measurements, some: Flags) -> tuple[int | str, ...]:
    return tuple(np.array(fresh.ids, dtype=object)[some])


def _predicted(p_value: float, found: tuple[Departure, ...]) -> bool:
    return p_value >= REFUSED_P and all(d.p_value >= DIRECTED_P for d in found)


def _fresh(learned: Fit, fresh: Measurements, ratio: float) -> Readings:
    """Fresh readings under a model learned on others; `ratio` of their noise to the specification."""
    model = Model(learned.model.mechanism.of(fresh), learned.model.reference, learned.model.terms)
    conditions = model.conditions(learned.x[: model.base_size], first=False)
    return readings(model, learned.x, model.mechanism.measured, model.mechanism.row_sd * ratio, conditions)


def _root(learned: Fit, before: Readings) -> Real:
    """(X, N) root of the covariance of all unknowns, the searched ones included."""
    held = np.zeros((len(learned.prior.root), before.by_unknown.shape[1]))
    held[:, : learned.prior.root.shape[1]] = learned.prior.root
    stacked = np.concatenate([before.by_unknown / before.row_sd[:, None], held])
    norms = np.linalg.norm(stacked, axis=0)
    norms[norms == 0.0] = 1.0
    return np.asarray(np.linalg.pinv(stacked / norms, rcond=BLIND) / norms[:, None])
