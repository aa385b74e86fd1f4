"""Figures of the whole set: means over all explanations, variances that include their differences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis.explanations.settle import Settled
from station.diagnosis.explanations.situation import Around, Commanded, Situation, at_commands
from station.five_bar import GRID, FiveBar, inverse
from station.records import Complex, Real

SHARE = 0.004
"""Explanations with a smaller probability are not used for the figures."""
FORM = 1.3
"""Factor on the uncertainty under an unnamed error, whose form only approximates the true one.

Set on half of 28 kinds of random machines with an unnamed error: their 95 % intervals contained 91 % without
the factor and contain 96 % with it; those of the other half, 91 % and 95 %.
"""
DRAWS = 400
STEPS = 3
"""Newton steps to the commands; the second is exact to a micrometre."""


@dataclass(frozen=True)
class PositionError:
    """Over the workspace, mm."""

    rms: float
    max: float
    bound_95: float
    """Bound that holds everywhere for 95 % of the machines that the set describes."""


@dataclass(frozen=True)
class Mixture:
    """Explanations with their probabilities, as one distribution."""

    mechanism: FiveBar
    situation: Situation
    """The situation of the readings."""
    settled: tuple[Settled, ...]
    weight: Real
    """(E,) sums to one."""

    @property
    def mean(self) -> Real:
        """(P,) base parameters, mm and rad."""
        size = self.settled[0].size
        return np.asarray(sum(w * s.x[:size] for w, s in zip(self.weight, self.settled, strict=True)))

    @property
    def covariance(self) -> Real:
        """(P, P): mean of the covariances and covariance of the means."""
        size = self.settled[0].size
        return spread(
            [s.x[:size] for s in self.settled],
            [s.covariance[:size, :size] for s in self.settled],
            self.weight,
        )

    def commands(self, place: Complex, around: Around | None = None) -> Real:
        """(G, 2) joint commands, rad, that bring P to positions (G,), mm, on average over the set."""
        theta = inverse(self.mechanism.nominal, place)
        around = around or _plain(len(place))
        for _ in range(STEPS):
            arrived = [self._arrived(s, theta, around) for s in self.settled]
            mean = sum(w * r for w, (r, _) in zip(self.weight, arrived, strict=True))
            by_joint = arrived[0][1].situation.by_target[:, :, :2]
            error = place - mean
            theta = (
                theta
                + np.linalg.solve(by_joint, np.stack([error.real, error.imag], axis=1)[:, :, None])[:, :, 0]
            )
        return np.asarray(theta)

    def positions(self, theta: Real, around: Around) -> Complex:
        """(G,) position of P on average over the set, mm, at joint commands theta (G, 2), rad."""
        return np.asarray(
            sum(
                w * self._arrived(s, theta, around)[0] for w, s in zip(self.weight, self.settled, strict=True)
            )
        )

    def position_error(self, theta: Real, place: Complex) -> PositionError:
        """Expected error of joint commands theta (G, 2) meant for positions (G,)."""
        expected, drawn = self.errors_at(theta, place)
        bound = float(np.quantile(drawn.max(axis=0), 0.95))
        return PositionError(float(np.sqrt(np.mean(expected**2))), float(expected.max()), bound)

    def errors_at(self, theta: Real, place: Complex) -> tuple[Real, Real]:
        """Root mean square (G,) of the position error, mm, and the errors (G, DRAWS) of drawn machines."""
        rng = np.random.default_rng(0)
        drawn, square = [], np.zeros(len(place))
        counts = np.floor(self.weight * DRAWS + rng.random()).astype(int)
        counts[0] += DRAWS - counts.sum()
        for s, w, count in zip(self.settled, self.weight, counts, strict=True):
            r, at = self._arrived(s, theta, _plain(len(place)))
            mean = np.stack([(r - place).real, (r - place).imag], axis=1)
            root = self._moved(s, at) @ root_of(s.covariance)
            square += w * (np.sum(mean**2, axis=1) + np.sum(root**2, axis=(1, 2)))
            if count > 0:
                error = mean[:, :, None] + root @ rng.standard_normal((root.shape[2], count))
                drawn.append(np.sqrt(np.sum(error**2, axis=1)))
        return np.sqrt(square), np.concatenate(drawn, axis=1)

    def before_and_after(self, base: Settled) -> tuple[PositionError, PositionError]:
        """Position error over the workspace: with the commands of the base model, and of the set."""
        place = self.mechanism.robot.workspace_grid(*GRID)
        after = self.position_error(self.commands(place), place)
        if len(self.settled) == 1 and self.settled[0] is base:
            return after, after
        return self.position_error(self.only(base).commands(place), place), after

    def only(self, settled: Settled) -> Mixture:
        """One explanation alone."""
        return Mixture(self.mechanism, self.situation, (settled,), np.ones(1))

    def _arrived(self, s: Settled, theta: Real, around: Around) -> tuple[Complex, Commanded]:
        """(G,) position of P under one explanation."""
        at = at_commands(self.mechanism, s.x[: s.size], self.situation, theta, around)
        r = at.r
        for family, member, amplitudes in s.present:
            moved = (family.columns(at.situation, member)[0] @ amplitudes).reshape(-1, 2)
            r = r + moved[:, 0] + 1j * moved[:, 1]
        return r, at

    def _moved(self, s: Settled, at: Commanded) -> Real:
        """(G, 2, P + q) derivative of the position with respect to all unknowns of one explanation."""
        columns = [
            f.columns(at.situation, c.member)[0].reshape(len(at.r), 2, -1)
            for f, c in zip(s.families, s.choices, strict=True)
        ]
        return np.concatenate([at.situation.by_parameter, *columns], axis=2)


def _plain(count: int) -> Around:
    return Around(np.zeros((count, 2)))


def mixture(mechanism: FiveBar, situation: Situation, settled: Sequence[tuple[Settled, float]]) -> Mixture:
    """The mixture of explanations with probabilities, without negligible ones."""
    kept = [(s, w) for s, w in settled if w >= SHARE] or [settled[0]]
    weight = np.array([w for _, w in kept])
    return Mixture(mechanism, situation, tuple(_unsure_of_form(s) for s, _ in kept), weight / weight.sum())


def _unsure_of_form(settled: Settled) -> Settled:
    # zero offsets and lengths take up a part of an unnamed error, unless it depends on time
    if all(family.named or family.depends_on == "time" for family in settled.families):
        return settled
    return replace(settled, covariance=FORM**2 * settled.covariance)


def spread(means: Sequence[Real], covariances: Sequence[Real], weight: Real) -> Real:
    """(P, P) covariance of a mixture: law of total variance."""
    middle = sum(w * m for w, m in zip(weight, means, strict=True))
    return np.asarray(
        sum(
            w * (C + np.outer(m - middle, m - middle))
            for w, m, C in zip(weight, means, covariances, strict=True)
        )
    )


def root_of(covariance: Real) -> Real:
    """(X, X) root of a covariance; variances may differ by many orders of magnitude."""
    sd = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    values, vectors = np.linalg.eigh(covariance / np.outer(sd, sd))
    return np.asarray(sd[:, None] * vectors * np.sqrt(np.maximum(values, 0.0)))
