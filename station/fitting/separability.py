"""Which parameters the readings cannot distinguish, by name, and the dependences between them.

Each unknown is scaled by its own tolerance. Pivoted QR of the whitened Jacobian picks, one after another, the
parameter that the readings determine best beside those picked before; the others are determined by their
tolerances, and each is reported with the parameters that it cannot be distinguished from.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr

from station.fitting.least_squares import Solution
from station.mechanism import Mechanism
from station.records import Phrase, Real, WeakDirection, phrase

TIED = 1.0
"""Information of the readings over that of the tolerance, below which the tolerance dominates."""
FREE = 1e6
"""Assumed tolerance of an unknown without one, over its standard deviation from the readings."""
ALIKE = 0.3
"""Cosine from which a tied parameter is reported as similar to another."""
MOST_NAMED = 3


@dataclass(frozen=True, slots=True)
class Tied:
    """A parameter that the readings do not determine beside the others."""

    name: str
    looks_like: tuple[str, ...]
    """Parameters with the same effect, most similar first; empty: it has no effect on the readings at all."""

    @property
    def said(self) -> Phrase:
        """The parameter with those that it cannot be distinguished from."""
        if not self.looks_like:
            return phrase("not_seen", parameter=self.name)
        return phrase("looks_like", parameter=self.name, looks_like=", ".join(self.looks_like))


def describe_separability(
    mechanism: Mechanism, solution: Solution, row_sd: Real, sd_factor: float
) -> WeakDirection:
    """The zero offset that the readings determine least, and what tolerances alone determine.

    sd_deg is the largest standard uncertainty of a zero offset that is not tied; `blind` names the tied ones.
    """
    tied = separate(mechanism, solution)
    names = {t.name for t in tied}
    joints = mechanism.theta.shape[1]
    sd = np.degrees(np.sqrt(np.diag(solution.covariance)[:joints])) * sd_factor
    seen = [k for k in range(joints) if f"dtheta{k + 1}" not in names]
    weakest = max(seen, key=lambda k: sd[k], default=None)
    zero = (
        phrase("no_zero_offset") if weakest is None else phrase("parameter", parameter=f"dtheta{weakest + 1}")
    )
    said = phrase("held_by_tolerances", zero=zero, tied=len(tied), parameters=len(mechanism.parameters))
    blind = tuple(t.said for t in tied)
    return WeakDirection(
        singular_ratio=float(solution.singular_values[-1] / solution.singular_values[0]),
        text=said.text(),
        said=said,
        sd_deg=float(sd.max() if weakest is None else sd[weakest]),
        blind=tuple(one.text() for one in blind),
        blind_said=blind,
    )


def separate(mechanism: Mechanism, solution: Solution) -> tuple[Tied, ...]:
    """The parameters that only their tolerances determine, by name."""
    names = [p.name for p in mechanism.parameters]
    J = solution.jacobian[:, : len(names)]
    norms = np.linalg.norm(J, axis=0)
    tolerance = np.array([p.prior_sd for p in mechanism.parameters])
    scale = np.where(np.isfinite(tolerance), tolerance, FREE / np.maximum(norms, 1e-300))
    R, order = qr(J * scale, mode="r", pivoting=True)
    R = R[: len(names)]
    rank = int(np.sum(np.abs(np.diag(R)) > TIED))
    return tuple(_tied(names, order, R, k, rank) for k in range(rank, len(names)))


def _tied(names: list[str], order: NDArray[np.signedinteger], R: Real, k: int, rank: int) -> Tied:
    column = R[:rank, k]
    size = float(np.linalg.norm(column))
    if size <= TIED:
        return Tied(names[order[k]], ())
    cosine = np.abs(column @ R[:rank, :rank]) / (size * np.linalg.norm(R[:rank, :rank], axis=0))
    best = [j for j in np.argsort(-cosine)[:MOST_NAMED] if cosine[j] >= ALIKE]
    return Tied(names[order[k]], tuple(names[order[j]] for j in best))
