"""The measurement model with effects added, and its fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag

from station.effects import Acts, Effect, signature
from station.fitting import MAX_STEPS, Prior, Solution, solve
from station.mechanism import Conditions, Mechanism, Observation, Reference
from station.records import Index, Real

CONDITION_ROUNDS = 12
"""The basis depends slightly on the zero offsets: it is fitted and evaluated until it is stable."""
SETTLED_MM = 2e-5
SETTLED_SDS = 2e-3
LONG_ROWS = 1000
LONG_WITHOUT_REPEATS = 350
"""With fewer rows, the residual determines the scatter if there are no repeats."""


@dataclass(frozen=True)
class Term:
    """An effect with its hidden parameters fixed."""

    effect: Effect
    hidden: Mapping[str, float]
    acts: Acts
    size: int
    """Number of amplitudes."""
    spread: Real | None = None
    """(q,) prior standard deviation of the amplitudes; None if only the readings determine them."""

    @property
    def key(self) -> tuple[str, int | None]:
        return self.effect.id, self.effect.joint


@dataclass(frozen=True)
class Model:
    """A mechanism with terms; unknowns are its parameters, then the terms' amplitudes."""

    mechanism: Mechanism
    reference: Reference
    terms: tuple[Term, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(p.name for p in self.mechanism.parameters)

    @property
    def base_size(self) -> int:
        return len(self.mechanism.parameters)

    @property
    def unknowns(self) -> int:
        return self.base_size + sum(term.size for term in self.terms)

    @property
    def spread(self) -> Real:
        """(unknowns - base_size,) prior standard deviation of every amplitude, inf for none."""
        parts = [np.full(t.size, np.inf) if t.spread is None else t.spread for t in self.terms]
        return np.concatenate([*parts, np.zeros(0)])

    def prior(self, base: Prior) -> Prior:
        """Prior of all unknowns, from that of the base parameters."""
        if not self.terms:
            return base
        amplitudes = Prior.independent(np.zeros(len(self.spread)), self.spread)
        return Prior(np.concatenate([base.mean, amplitudes.mean]), block_diag(base.root, amplitudes.root))

    def conditions(self, p: Real, *, first: bool = True) -> Conditions:
        return self.mechanism.conditions(p, self.reference, first=first)

    def bases(self, c: Conditions) -> list[Real]:
        """(K, q) basis of each term under the conditions."""
        return [term.effect.at(term.hidden, c) for term in self.terms]

    def observe(self, x: Real, bases: list[Real]) -> Observation:
        """Prediction with all derivatives; by_parameter has the terms' columns appended."""
        at = self.mechanism.observe(x[: self.base_size], self.turned(x, bases))
        if not self.terms:
            return at
        amplitudes = self._split(x)
        rows = self.mechanism.reading_of_row
        value, columns = at.value, [at.by_parameter]
        for term, basis, a in zip(self.terms, bases, amplitudes, strict=True):
            column = signature(term.acts, basis, at, self.names, rows)
            if not term.acts.turns:
                value = value + column @ a
            columns.append(column)
        return Observation(value, np.hstack(columns), at.by_joint, at.motions)

    def turned(self, x: Real, bases: list[Real]) -> Real:
        """(K, n) joint angles including the effects on joints, rad."""
        theta = self.mechanism.theta
        if any(term.acts.turns for term in self.terms):
            theta = theta.copy()
            for term, basis, a in zip(self.terms, bases, self._split(x), strict=True):
                if term.acts.joint is not None:
                    theta[:, term.acts.joint] += basis @ a
                elif term.acts.motion is not None:
                    theta += (basis @ a)[:, None] * self.mechanism.measurements.motion(term.acts.motion)
        return theta

    def _split(self, x: Real) -> list[Real]:
        out, at = [], self.base_size
        for term in self.terms:
            out.append(x[at : at + term.size])
            at += term.size
        return out


@dataclass(frozen=True)
class Fit:
    """A model fitted to its mechanism's readings."""

    model: Model
    solution: Solution
    prior: Prior
    row_sd: Real

    @property
    def x(self) -> Real:
        return self.solution.x

    @cached_property
    def conditions(self) -> Conditions:
        """The conditions of the readings, at the fit."""
        return self.model.conditions(self.x[: self.model.base_size])

    @cached_property
    def at(self) -> Observation:
        """Observation of the mechanism at the fit, joints turned by the effects; without terms' columns."""
        bases = self.model.bases(self.conditions) if self.model.terms else []
        return self.model.mechanism.observe(self.x[: self.model.base_size], self.model.turned(self.x, bases))

    @property
    def residual_mm(self) -> Real:
        """(R,) measured less predicted."""
        return -self.solution.residual * self.row_sd

    @property
    def cost(self) -> float:
        return self.solution.cost

    @property
    def dof(self) -> int:
        """Degrees of freedom of the cost: rows less the unknowns that only the rows determine."""
        return len(self.row_sd) - self.prior.free

    @property
    def freedom(self) -> float:
        """Number of unknowns that the rows determine: all, less the information of the prior."""
        C = self.solution.covariance
        held = np.isfinite(np.diag(C))
        root = self.prior.root[:, held]
        return float(held.sum() - np.sum((root @ C[np.ix_(held, held)]) * root))

    def part(self, index: int) -> Index:
        """(q,) indices of the amplitudes of term `index` among the unknowns."""
        start = self.model.base_size + sum(t.size for t in self.model.terms[:index])
        return np.arange(start, start + self.model.terms[index].size)

    def amplitudes(self, index: int) -> tuple[Real, Real]:
        """(q,) and covariance (q, q) of term `index`, in whitened units of row_sd."""
        part = self.part(index)
        return self.x[part], self.solution.covariance[np.ix_(part, part)]


def is_long(mechanism: Mechanism) -> bool:
    """Whether there are so many rows that candidates differ by more than their signatures' curvature."""
    return len(mechanism.row_sd) > (LONG_ROWS if mechanism.needs_repeats else LONG_WITHOUT_REPEATS)


def fit(
    model: Model,
    base_prior: Prior,
    row_sd: Real,
    start: Real | None = None,
    most_steps: int = MAX_STEPS,
) -> Fit:
    """Fit all unknowns of a model from `start`; by default from the start of the mechanism, without effects.

    :raises NotConvergedError: the fit does not converge.
    """
    prior = model.prior(base_prior)
    x = model.mechanism.start if start is None else start
    x = np.concatenate([x, np.zeros(model.unknowns - len(x))])
    measured = model.mechanism.measured
    bases = model.bases(model.conditions(x[: model.base_size])) if model.terms else []
    for _ in range(CONDITION_ROUNDS):

        def residuals(q: Real, bases: list[Real] = bases) -> tuple[Real, Real]:
            at = model.observe(q, bases)
            J = at.by_parameter
            J /= row_sd[:, None]  # in place: for a long log it is large
            return (at.value - measured) / row_sd, J

        solution = solve(residuals, x, prior, most_steps)
        x = solution.x
        if not model.terms or not solution.complete:
            break
        before = model.observe(x, bases).value
        bases = model.bases(model.conditions(x[: model.base_size]))
        moved = np.abs(model.observe(x, bases).value - before).max()
        if moved < max(SETTLED_MM, SETTLED_SDS * float(row_sd.min())):
            break
    return Fit(model, solution, prior, row_sd)
