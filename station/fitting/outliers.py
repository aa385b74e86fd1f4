"""Readings that disagree with all others: found, listed by id, and excluded with a reason, never silently.

A reading is an outlier only when it also disagrees with the other readings of its own position: an effect at
a position (a dent, a cable) appears in all of them and must not be excluded. Nor are the first or the last
few readings in time outliers: the machine was different then, and this must be reported.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import takewhile

import numpy as np
from scipy.special import ndtri

from station.errors import InputRefused
from station.fitting.least_squares import Solution
from station.mechanism import Mechanism, axis_of_row
from station.records import Index, Measurements, OutlierNote, Phrase, Real, phrase

SIGNIFICANCE = 1e-3
"""Level for the whole set of readings (Bonferroni)."""
LARGEST_SHARE = 0.1
FEW = 40
"""With fewer readings, a scatter smaller than specified is not reliable."""
SUSPICIOUS = 1.5
"""Scatter above the specification by this factor may be caused by gross readings."""
CAUCHY = 2.385
"""Tuning constant of the Cauchy weight, in standard deviations (95 % efficient for normal noise)."""
ROBUST_STEPS = 12


@dataclass(frozen=True)
class Outlier:
    """One excluded reading."""

    reading: int | str
    residual_mm: float
    times_sd: float

    @property
    def said(self) -> Phrase:
        """The reason to exclude it."""
        return phrase("off_by", off_um=self.residual_mm * 1e3, times=self.times_sd)

    @property
    def reason(self) -> str:
        """The same in English."""
        return self.said.text()

    def record(self) -> OutlierNote:
        """The outlier as documents contain it."""
        return OutlierNote(
            reading=self.reading, residual_mm=self.residual_mm, reason=self.reason, said=self.said
        )


Fit = Callable[[Real], Solution]
"""Row standard deviations (R,) -> fit of all readings whitened with them."""


def find_outliers(mechanism: Mechanism, fit: Fit, row_sd: Real) -> tuple[Outlier, ...]:
    """The outlying readings against a robust fit; `row_sd` (R,) is the expected scatter of the rows.

    Plain least squares follows gross readings until good ones look wrong, so the fit is repeated with Cauchy
    weights until only the majority determines it.
    """
    solution = fit(row_sd)
    residual = -solution.residual
    t = residual / np.sqrt(_left(solution))
    scale = _scale(t)
    limit = _limit(t)
    if np.abs(t).max() <= limit * scale and scale < SUSPICIOUS:
        return ()
    for _ in range(ROBUST_STEPS):
        stretch = np.sqrt(1.0 + (t / (CAUCHY * scale)) ** 2)
        solution = fit(row_sd * stretch)
        residual = -solution.residual * stretch
        t = residual / np.sqrt(_left(solution))
        scale = _scale(t)
    return _named(mechanism, residual, t, scale, row_sd)


def outliers_of_fit(mechanism: Mechanism, solution: Solution, row_sd: Real) -> tuple[Outlier, ...]:
    """The outlying readings against a fit that the majority already determines."""
    residual = -solution.residual
    t = residual / np.sqrt(_left(solution))
    return _named(mechanism, residual, t, _scale(t), row_sd)


def _limit(t: Real) -> float:
    return float(-ndtri(SIGNIFICANCE / (2 * len(t))))


def _named(mechanism: Mechanism, residual: Real, t: Real, scale: float, row_sd: Real) -> tuple[Outlier, ...]:
    """Outliers with a row beyond the limit, by the row that is furthest off."""
    limit = _limit(t) * scale
    suspects = np.flatnonzero(np.abs(t) > limit)
    worst: dict[int, int] = {}
    for k in suspects[np.argsort(np.abs(t[suspects]))]:
        if _apart(mechanism, residual, int(k), suspects) > limit:
            worst[int(mechanism.reading_of_row[k])] = int(k)
    for reading in _at_an_end(mechanism.measurements, {reading: residual[k] for reading, k in worst.items()}):
        del worst[reading]
    ids = mechanism.measurements.ids
    return tuple(
        Outlier(ids[reading], float(residual[k] * row_sd[k]), float(abs(t[k]) / scale))
        for reading, k in sorted(worst.items())
    )


def _at_an_end(measurements: Measurements, off: Mapping[int, float]) -> set[int]:
    """Those of the deviating readings that form a run up to an end of the sequence in time.

    A slip or a step between readings makes all readings on one side of it deviate; two to different sides are
    chance.
    """
    in_time = [int(k) for k in np.argsort(measurements.t_s, kind="stable")]
    found: set[int] = set()
    for way in (in_time, in_time[::-1]):
        run = list(takewhile(off.__contains__, way))
        if len(run) > 2 or (len(run) == 2 and off[run[0]] * off[run[1]] > 0.0):
            found |= set(run)
    return found


def _left(solution: Solution) -> Real:
    """(R,) share of each row's variance that the fit leaves in its residual."""
    finite = np.isfinite(np.diag(solution.covariance))
    J, C = solution.jacobian[:, finite], solution.covariance[np.ix_(finite, finite)]
    left = 1.0 - np.einsum("ki,ki->k", J @ C, J)
    # a reading that alone determines a parameter cannot be judged
    return np.where(left > 0.05, left, np.inf)


def _scale(t: Real) -> float:
    """Scatter of the majority, in specified standard deviations."""
    judged = np.abs(t[t != 0.0])
    if len(judged) == 0:
        return 1.0
    scale = 1.4826 * float(np.median(judged))
    return max(scale, 1.0) if len(t) < FEW else scale


def _apart(mechanism: Mechanism, residual: Real, k: int, suspects: Index) -> float:
    """Deviation of row k from the same coordinate of the others at its position; inf without others."""
    reading, axis = mechanism.reading_of_row, axis_of_row(mechanism)
    place = mechanism.measurements.position[reading]
    companions = np.flatnonzero((place == place[k]) & (axis == axis[k]))
    companions = companions[companions != k]
    if not companions.size:
        return np.inf
    sound = companions[~np.isin(companions, suspects)]
    return float(np.abs(residual[k] - residual[sound if sound.size else companions].mean()))


def few_enough(left_out: tuple[Outlier, ...], readings: int) -> bool:
    """Whether at most a tenth of the readings, or one, is excluded: more indicate a missing effect."""
    return len(left_out) <= max(1, int(LARGEST_SHARE * readings))


def check_outlier_share(left_out: tuple[Outlier, ...], readings: int) -> None:
    """:raises InputRefused: more than a tenth of the readings (at least one) would be excluded."""
    if not few_enough(left_out, readings):
        names = ", ".join(str(o.reading) for o in left_out)
        raise InputRefused(
            f"Readings {names} disagree with the rest, more than a tenth of {readings}; "
            "measure again and check the scale and its mounting."
        )
