"""One explanation settled by the nonlinear model: parameters, covariance and evidence.

About the linearisation point of the search, a large error (a link 5 mm too long, a ratio 1 % wrong) leaves
tens of micrometres of curvature. Each probable explanation is therefore fitted again with Gauss-Newton steps,
and its evidence is taken at its own minimum (Laplace).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis.explanations.evidence import Choice
from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.frame import Frame, Present, added, frame
from station.diagnosis.explanations.noise_level import NoiseLevel
from station.diagnosis.explanations.situation import predicted
from station.mechanism import Reference
from station.records import Real

STEPS = 5
STRAIGHT = 0.2
"""Largest difference between model and tangent, in standard deviations, that is accepted."""


@dataclass(frozen=True)
class Settled:
    """The posterior of one explanation: x = base parameters, then amplitudes, ~ N(x, covariance)."""

    choices: tuple[Choice, ...]
    families: tuple[Family, ...]
    x: Real
    """(P + q,)"""
    covariance: Real
    log_evidence: float
    """At these members and sizes, noise level averaged; absolute, up to a constant of the readings."""
    cost: float
    """Sum of squares of residual and prior at the minimum, in units of the specified noise."""
    level: float
    """Noise over the specification."""
    bend: float
    """Largest difference between the model and the tangent of the search, in standard deviations."""
    row_sd: Real

    @property
    def size(self) -> int:
        """Number of base parameters."""
        return len(self.x) - sum(f.width for f in self.families)

    @property
    def amplitudes(self) -> tuple[Real, ...]:
        """(q,) of each error."""
        return tuple(self.x[part] for part in self.parts)

    @property
    def parts(self) -> tuple[slice, ...]:
        """Position of each error's amplitudes in x."""
        out, at = [], self.size
        for family in self.families:
            out.append(slice(at, at + family.width))
            at += family.width
        return tuple(out)

    @property
    def impossible(self) -> bool:
        """Whether an error has a size that no machine has: backlash is not negative."""
        return any(
            f.one_sided and bool(np.any(a < 0.0)) for f, a in zip(self.families, self.amplitudes, strict=True)
        )

    @property
    def present(self) -> tuple[Present, ...]:
        return tuple(
            Present(f, c.member, a)
            for f, c, a in zip(self.families, self.choices, self.amplitudes, strict=True)
        )


def settle(
    at: Frame, families: Sequence[Family], choices: Sequence[Choice], noise: NoiseLevel, reference: Reference
) -> Settled:
    """Fit one explanation, starting from a frame."""
    chosen = tuple(families[c.family] for c in choices)
    sizes = [np.full(f.width, f.sizes[c.node]) for f, c in zip(chosen, choices, strict=True)]
    prior_sd = np.concatenate([at.prior_sd, *sizes])
    solved = _solved(at, chosen, choices, prior_sd, noise)
    bend = _bend(at, solved)
    here = at
    for _ in range(STEPS):
        if not solved.bend > STRAIGHT:
            break
        here = frame(at.mechanism, solved.x[: solved.size], reference, at.row_sd, solved.present)
        if not np.isfinite(here.observed).all():
            return replace(solved, log_evidence=-np.inf)
        solved = _solved(here, chosen, choices, prior_sd, noise)
        solved = replace(solved, bend=_bend(here, solved))
    return replace(solved, bend=bend)


def _bend(at: Frame, solved: Settled) -> float:
    """Largest difference between the model and the tangent at the solution."""
    model = predicted(at.mechanism, solved.x[: solved.size], added(at.situation, solved.present))
    tangent = _tangent(at, solved.families, solved.choices) @ (
        solved.x - np.concatenate([at.prior_mean, np.zeros(len(solved.x) - solved.size)])
    )
    residual = (at.mechanism.measured - model) / at.row_sd
    off = np.abs(residual - (at.observed - tangent)).max()
    return float(off) if np.isfinite(off) else np.inf


def _tangent(at: Frame, families: Sequence[Family], choices: Sequence[Choice]) -> Real:
    """(K, P + q) in row_sd."""
    columns = [at.signature(f, c.member)[0] for f, c in zip(families, choices, strict=True)]
    return np.hstack([at.jacobian, *columns])


def _solved(
    at: Frame, families: tuple[Family, ...], choices: Sequence[Choice], prior_sd: Real, noise: NoiseLevel
) -> Settled:
    A = _tangent(at, families, choices) * prior_sd
    U, D, Vt = np.linalg.svd(A, full_matrices=A.shape[1] > len(A))
    rotated = U.T @ at.observed
    cost = float(at.observed @ at.observed - np.sum(D**2 / (1.0 + D**2) * rotated**2))
    level = noise.level(cost)
    z = Vt[: len(D)].T @ (D / (level**2 + D**2) * rotated)
    left = np.ones(len(prior_sd))
    left[: len(D)] = level**2 / (level**2 + D**2)
    covariance = (Vt.T * left) @ Vt
    mean = np.concatenate([at.prior_mean, np.zeros(len(prior_sd) - len(at.prior_mean))])
    solved = Settled(
        choices=tuple(choices),
        families=families,
        x=mean + prior_sd * z,
        covariance=covariance * np.outer(prior_sd, prior_sd),
        log_evidence=float(noise(np.array(cost))) - 0.5 * float(np.sum(np.log1p(D**2))),
        cost=cost,
        level=level,
        bend=0.0,
        row_sd=at.row_sd,
    )
    return replace(solved, bend=_bend(at, solved))
