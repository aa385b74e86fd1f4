"""Readings as a linear problem about one point, whitened so that the geometry's part costs nothing.

About a point the readings are e = J (p - m) + B a + noise with the prior mean m of the base parameters. The
covariance of J (p - m) + noise, in units of the noise, is 1 + J S J'; its inverse root turns e and every
column B into a problem with white noise in which the base parameters no longer appear.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.situation import TARGETS, Situation, at_readings, predicted
from station.five_bar import FiveBar
from station.mechanism import Reference
from station.records import Real

FLAT_SD = 1e4
"""Prior standard deviation, mm, of a parameter about which nothing is known (the reading offset)."""


class Present(NamedTuple):
    """An error at one of its members, with amplitudes."""

    family: Family
    member: int
    amplitudes: Real


@dataclass(frozen=True)
class Frame:
    """K readings linearised at base parameters `p` with the errors `present`."""

    mechanism: FiveBar
    p: Real
    """(P,)"""
    present: tuple[Present, ...]
    situation: Situation
    row_sd: Real
    """(K,) mm"""
    prior_mean: Real
    prior_sd: Real
    """(P,)"""
    observed: Real
    """(K,) e: measured less the tangent's prediction at the prior mean, in row_sd."""
    jacobian: Real
    """(K, P) in row_sd."""

    @cached_property
    def _taken(self) -> tuple[Real, Real]:
        """Directions (K, P) that the base parameters move, and the share that whitening removes from each."""
        U, D, _ = np.linalg.svd(self.jacobian * self.prior_sd, full_matrices=False)
        return U, 1.0 - 1.0 / np.sqrt(1.0 + D**2)

    @property
    def parameters_taken(self) -> float:
        """How many base parameters the readings determine."""
        return float(np.sum(1.0 - (1.0 - self._taken[1]) ** 2))

    def whiten(self, rows: Real) -> Real:
        """Rows (..., K) over the readings, in mm over row_sd, whitened."""
        U, share = self._taken
        flat = rows.reshape(-1, rows.shape[-1])
        flat = flat - ((flat @ U) * share) @ U.T
        return flat.reshape(rows.shape)

    @cached_property
    def white(self) -> Real:
        """(K,) whitened observation."""
        return self.whiten(self.observed)

    def signature(self, family: Family, member: int | None = None) -> Real:
        """(V, K, q) in row_sd, not whitened."""
        return family.columns(self.situation, member) / self.row_sd[:, None]


def added(s: Situation, present: Sequence[Present]) -> Real | None:
    """(K, 13) contribution of the errors to the targets; None without errors."""
    if not present:
        return None
    out = np.zeros((len(s), len(TARGETS)))
    for family, member, amplitudes in present:
        out += family.added(s, member, amplitudes)
    return out


def frame(
    mechanism: FiveBar, p: Real, reference: Reference, row_sd: Real, present: Sequence[Present] = ()
) -> Frame:
    """Linearise the readings of `mechanism` at p (P,) with these errors present."""
    before = at_readings(mechanism, p, reference)
    more = added(before, present)
    s = before if more is None else at_readings(mechanism, p, reference, more)
    mean = np.array([q.prior_mean for q in mechanism.parameters])
    sd = np.array([q.prior_sd for q in mechanism.parameters])
    sd = np.where(np.isfinite(sd), sd, FLAT_SD)
    jacobian = s.by_parameter[:, 0, :]
    e = mechanism.measured - predicted(mechanism, p, more) + jacobian @ (p - mean)
    for family, member, amplitudes in present:
        e = e + family.columns(s, member)[0] @ amplitudes
    return Frame(mechanism, p, tuple(present), s, row_sd, mean, sd, e / row_sd, jacobian / row_sd[:, None])
