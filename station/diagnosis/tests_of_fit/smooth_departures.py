"""Smooth departures from any model: in time, by approach and position, by position, along angle or travel.

The catalogue names causes; these are unnamed, and a cause must leave none of them. A residual is compared
with a few smooth columns of each kind, after the part that the model could still take up is projected out of
them (added variables: Cook and Weisberg, Residuals and Influence in Regression, 1982, section 2.3.2). The
null hypothesis of each F test is that the residual is noise.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import fdtrc

from station.fitting import Prior
from station.mechanism import Conditions, axes
from station.model import Fit, Model, is_long
from station.records import Flags, Index, Real

SLOW, SMOOTH = 6, 8
"""Half waves over the readings in time order, and in order of an angle or the travel."""
OVER = (6, 3, 3)
"""Half waves over the workspace: across, up, and in the third direction where there is one."""
MOST = 600
"""Number of readings used of a long log, evenly spread: they show what a residual depends on."""
LOST = 1e-3
"""Minimum share of a column after projection; below it the column has no information of its own."""
STEP = 1e-4
"""Relative step of the difference quotient of a searched parameter."""


@dataclass(frozen=True)
class Departure:
    """One kind of dependence of a residual."""

    on: str
    share: float
    """Share of the residual's sum of squares, beyond what as many columns take of noise; 0 to 1."""
    p_value: float


@dataclass(frozen=True)
class Readings:
    """K readings in R rows with a model's residual and its derivatives with respect to its unknowns."""

    residual_mm: Real
    """(R,) measured less predicted."""
    by_unknown: Real
    """(R, X) mm: derivatives by the model's parameters, then by its searched ones."""
    row_sd: Real
    """(R,) mm"""
    reading: Index
    """(R,) number of the reading of each row."""
    conditions: Conditions
    at: Real
    """(K, d) position of the end of the machine, mm."""

    def take(self, some: Flags) -> Readings:
        """Only these readings, mask (K,)."""
        rows = some[self.reading]
        return Readings(
            self.residual_mm[rows],
            self.by_unknown[rows],
            self.row_sd[rows],
            (np.cumsum(some) - 1)[self.reading[rows]],
            self.conditions.take(some),
            self.at[some],
        )


def readings(model: Model, x: Real, measured: Real, row_sd: Real, c: Conditions) -> Readings:
    """The readings of a model at its unknowns x (X,), with measured (R,), mm."""
    predicted = model.observe(x, model.bases(c))
    J = np.column_stack([predicted.by_parameter, *(column for *_, column in by_searched(model, x, c))])
    at = model.mechanism.places(x[: model.base_size])
    return Readings(measured - predicted.value, J, row_sd, model.mechanism.reading_of_row, c, at)


def by_searched(model: Model, x: Real, c: Conditions) -> Iterator[tuple[int, str, Real]]:
    """Number of the term, name and (K,) derivative of every searched parameter that is not on a grid."""
    for k, term in enumerate(model.terms):
        for name in term.effect.refined(term.hidden, c):
            step = STEP * (abs(term.hidden[name]) or 1.0)
            up, down = (turned(model, k, name, by) for by in (step, -step))
            yield k, name, (_value(up, x, c) - _value(down, x, c)) / (2.0 * step)


def turned(model: Model, k: int, name: str, by: float) -> Model:
    """The model with a searched parameter of term k changed."""
    term = model.terms[k]
    changed = replace(term, hidden={**term.hidden, name: term.hidden[name] + by})
    return replace(model, terms=(*model.terms[:k], changed, *model.terms[k + 1 :]))


def _value(model: Model, x: Real, c: Conditions) -> Real:
    return model.observe(x, model.bases(c)).value


class WhitenedResidual:
    """A model's residual, after the part that its unknowns could take up is projected out.

    Whitened rows: the readings of all parts, then those of the prior.
    """

    def __init__(self, parts: tuple[Readings, ...], prior: Prior, x: Real) -> None:
        """`parts` in time order; prior and x of the model's parameters."""
        self.row_sd: Real = np.concatenate([part.row_sd for part in parts])
        """(R,) mm"""
        self.at: Real = np.concatenate([part.at for part in parts])
        """(K, d) position of the end of the machine, mm."""
        before = np.cumsum([0, *(len(part.at) for part in parts)])
        self.reading: Index = np.concatenate(
            [part.reading + first for part, first in zip(parts, before, strict=False)]
        )
        """(R,) number of the reading of each row."""
        self.axis: Index = axes(self.reading)
        """(R,) index of the coordinate of each row."""
        J = np.concatenate([part.by_unknown / part.row_sd[:, None] for part in parts])
        held = np.zeros((len(prior.root), J.shape[1]))
        held[:, : prior.root.shape[1]] = prior.root
        z = [*(part.residual_mm / part.row_sd for part in parts), prior.root @ (prior.mean - x)]
        self.taken = _orthonormal(np.concatenate([J, held]))
        """(N, X) directions that the unknowns can take up."""
        self.left = perpendicular(np.concatenate(z), self.taken)
        """(N,)"""
        self.dof = len(self.left) - J.shape[1]
        self.rows = len(J)
        """R: without those of the prior."""
        self._conditions = [part.conditions for part in parts]

    @property
    def square(self) -> float:
        return float(self.left @ self.left)

    def recorded(self, name: str) -> bool:
        """Whether the conditions of all readings contain it."""
        return all(getattr(c, name) is not None for c in self._conditions)

    def of(self, name: str) -> Real:
        """(K, ...) from the conditions of all readings."""
        return np.concatenate([getattr(c, name) for c in self._conditions])

    def spread(self, columns: Real) -> Real:
        """(N, q) whitened columns, from columns (K, q) in mm; separate for each coordinate of a reading."""
        count, coordinates = columns.shape[1], int(self.axis.max()) + 1
        rows = np.zeros((len(self.left), count * coordinates))
        for a in range(coordinates):
            own = np.flatnonzero(self.axis == a)
            rows[own, a * count : (a + 1) * count] = columns[self.reading[own]] / self.row_sd[own, None]
        return rows


def departures(residual: WhitenedResidual) -> tuple[Departure, ...]:
    """All kinds that these readings can show, in arbitrary order."""
    found = [added(residual, "time", half_waves(residual.of("t_s"), SLOW))]
    if np.any(residual.of("approach") != 0):
        found.append(added(residual, "approach x place", by_approach_and_place(residual), in_doubt(residual)))
    found.append(added(residual, "place", _over_workspace(residual)))
    theta = residual.of("theta")
    found += [added(residual, f"theta{i + 1}", half_waves(t, SMOOTH)) for i, t in enumerate(theta.T)]
    travel = residual.of("travel")
    if np.ptp(travel) > 0.0:
        found.append(added(residual, "travel", half_waves(travel, SMOOTH)))
    return tuple(found)


def added(residual: WhitenedResidual, on: str, columns: Real, beside: Real | None = None) -> Departure:
    """F test of columns (K, q) in mm; what columns `beside` (K, m) could take up is attributed to those."""
    taken, left = residual.taken, residual.left
    if beside is not None and beside.size:
        others = _orthonormal(perpendicular(residual.spread(beside), taken))
        left = perpendicular(left, others)
        taken = np.column_stack([taken, others])
    new = residual.spread(columns)
    new /= np.maximum(np.linalg.norm(new, axis=0), 1e-300)
    u, s, _ = np.linalg.svd(perpendicular(new, taken), full_matrices=False)
    new = u[:, s > LOST]
    along, size = new.T @ left, new.shape[1]
    # noise is the scatter of the readings' own rows: the width of a tolerance has no information on it
    left_of_rows = (left - new @ along)[: residual.rows]
    used = np.sum(taken[: residual.rows] ** 2) + np.sum(new[: residual.rows] ** 2)
    dof = residual.rows - float(used)
    noise = float(left_of_rows @ left_of_rows) / max(dof, 1.0)
    if size == 0 or dof < 1.0 or noise == 0.0:
        return Departure(on, 0.0, 1.0)
    won = float(along @ along)
    p_value = float(fdtrc(size, dof, won / size / noise))
    return Departure(on, float(max(won - size * noise, 0.0) / residual.square), p_value)


def in_doubt(residual: WhitenedResidual) -> Real:
    """(K, m) a separate column for each reading whose slider sense is unknown."""
    doubtful = residual.of("slider_direction") != residual.of("slider_net")
    return np.eye(len(doubtful))[:, doubtful]


def senses(residual: WhitenedResidual) -> Real:
    """(K, n + 1) sign of the last motion of joints and slider."""
    return np.column_stack([residual.of("approach"), residual.of("slider_direction")])


def by_approach_and_place(residual: WhitenedResidual) -> Real:
    """(K, 6 n) each sense of motion times a parabola over the (plane) workspace."""
    at = [_centred(v) for v in residual.at.T]
    squares = [a * b for i, a in enumerate(at) for b in at[i:]]
    smooth = np.column_stack([np.ones(len(residual.at)), *at, *squares])
    return np.asarray((senses(residual)[:, :, None] * smooth[:, None, :]).reshape(len(smooth), -1))


def _over_workspace(residual: WhitenedResidual) -> Real:
    angles = [np.pi * (_centred(v) + 1.0) / 2.0 for v in residual.at.T]
    counts = OVER[: len(angles)]
    waves = [
        np.prod([np.cos(k * angle) for k, angle in zip(number, angles, strict=True)], axis=0)
        for number in np.ndindex(*counts)
        if any(number)
    ]
    return np.column_stack(waves)


def perpendicular(columns: Real, taken: Real) -> Real:
    """Columns (N, ...) with orthonormal `taken` (N, X) projected out."""
    return np.asarray(columns - taken @ (taken.T @ columns))


def of_fit(fit: Fit, row_sd: Real) -> Readings:
    """The readings a model was learned on, with noise row_sd (R,), mm."""
    return readings(fit.model, fit.x, fit.model.mechanism.measured, row_sd, fit.conditions)


def whitened_residual(fit: Fit) -> WhitenedResidual:
    """A fit's residual for the readings it was learned on.

    In a long log only some readings are used, and only the parameters of the mechanism are projected out of
    them: the amplitudes of curves are determined by all readings.
    """
    if not is_long(fit.model.mechanism):
        return WhitenedResidual((of_fit(fit, fit.row_sd),), fit.prior, fit.x)
    size = fit.model.base_size
    mechanism = fit.model.mechanism
    some = np.zeros(len(mechanism.measurements), dtype=bool)
    some[:: -(-len(some) // MOST)] = True
    base = Readings(
        fit.residual_mm,
        fit.solution.jacobian[:, :size] * fit.row_sd[:, None],
        fit.row_sd,
        mechanism.reading_of_row,
        fit.conditions,
        mechanism.places(fit.x[:size]),
    )
    root = fit.prior.root[:, :size]
    prior = Prior(fit.prior.mean[:size], root[np.any(root != 0.0, axis=1)])
    return WhitenedResidual((base.take(some),), prior, fit.x[:size])


def _orthonormal(J: Real) -> Real:
    norms = np.linalg.norm(J, axis=0)
    return np.asarray(np.linalg.qr(J / np.where(norms > 0.0, norms, 1.0))[0])


def half_waves(along: Real, count: int) -> Real:
    """(K, count) cosines over the order of the readings along a quantity."""
    rank = np.argsort(np.argsort(along, kind="stable"), kind="stable")
    return np.asarray(np.cos(np.pi * (rank[:, None] + 0.5) / len(along) * np.arange(1, count + 1)))


def _centred(v: Real) -> Real:
    """Values scaled to -1 to 1."""
    low, high = float(v.min()), float(v.max())
    return np.asarray((2.0 * v - low - high) / ((high - low) or 1.0))
