"""The identified machine: the position of P for joint commands, and the commands for a position.

Effects on joints and links are included; effects on the reading move nothing. Effects of time have their
value at the end of the readings learned from, effects of temperature that at the given rise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from station.fitting import position_error_summary
from station.five_bar import (
    GRID,
    NAMES,
    SIZE,
    FiveBar,
    Geometry,
    Robot,
    inverse,
    lengths,
    load,
    perturbed,
    pose,
    position_jacobian,
    pull,
)
from station.mechanism import Conditions
from station.model.model import Fit, Term
from station.records import Complex, Phrase, PositionError, Real, phrase

SETTLED_RAD = 1e-12
MOST_STEPS = 60


class NotInvertible(ArithmeticError):
    """No command reaches the position; `said` is the reason."""

    def __init__(self, said: Phrase) -> None:
        super().__init__(said.text())
        self.said = said


@dataclass(frozen=True)
class Situation:
    """The conditions of K motions of the machine."""

    approach: Real
    """(K, n) sign of each joint's last motion; 0 uses the middle of the backlash."""
    temperature_rise: Real
    """(K,) K, above the first reading learned from."""
    payload_kg: Real
    """(K,)"""

    @classmethod
    def plain(cls, count: int, joints: int = 2) -> Situation:
        """No approach, no temperature rise, no payload."""
        return cls(np.zeros((count, joints)), np.zeros(count), np.zeros(count))


@dataclass(frozen=True)
class IdentifiedMachine:
    """Base parameters and effects of one fit."""

    robot: Robot
    x: Real
    """(X,) base parameters (the first twelve of the error model), then the terms' amplitudes."""
    covariance: Real
    """(X, X)"""
    terms: tuple[Term, ...]
    end_s: float
    """Time of the last reading learned from."""

    @property
    def by_approach(self) -> bool:
        """Whether a command depends on the side it is approached from."""
        return any(term.effect.by_approach for term in self.terms)

    @property
    def geometry(self) -> Geometry:
        """Geometry without effects."""
        return perturbed(self.robot.geometry, self.x[:SIZE])

    def positions(self, theta: Real, situation: Situation) -> Complex:
        """(K,) position of P, mm, for joint commands theta (K, 2), rad in the drives' nominal frame."""
        turned, moved = self._effects(theta, situation)
        return np.asarray(pose(self.geometry, theta + self.x[:2] + turned).r + moved)

    def commands(self, target: Complex, situation: Situation) -> Real:
        """(K, 2) joint commands, rad in the drives' nominal frame, that bring P to target (K,), mm.

        :raises Unreachable: naming the first target out of reach.
        :raises NotInvertible: no command exists because of the effects.
        """
        geometry = self.geometry
        theta = inverse(geometry, target) - self.x[:2]
        if not self.terms:
            return theta
        for _ in range(MOST_STEPS):
            turned, moved = self._effects(theta, situation)
            better = inverse(geometry, target - moved) - self.x[:2] - turned
            change = float(np.abs(better - theta).max())
            theta = better
            if change < SETTLED_RAD:
                return theta
        raise NotInvertible(phrase("effects_too_steep"))

    def position_error(self, commander: IdentifiedMachine | None = None) -> PositionError:
        """RMS and maximum over the workspace, mm, with the commands of `commander` (default: this machine).

        If that is another model, the errors it omits are added to the uncertainty of this one.
        """
        grid = self.robot.workspace_grid(*GRID)
        sides = [(1, 1), (1, -1), (-1, 1), (-1, -1)] if self.by_approach else [(0, 0)]
        situation = replace(
            Situation.plain(len(grid) * len(sides)),
            approach=np.repeat(sides, len(grid), axis=0).astype(float),
        )
        target = np.tile(grid, len(sides))
        theta = (commander or self).commands(target, situation)
        error = self.positions(theta, situation) - target
        return position_error_summary(
            np.column_stack([error.real, error.imag]), self.jacobian(theta, situation), self.covariance
        )

    def jacobian(self, theta: Real, situation: Situation) -> Real:
        """(K, 2, X) d (x, y) / d x at joint commands theta (K, 2)."""
        at = pose(self.geometry, theta + self.x[:2])
        by_base = position_jacobian(self.geometry, at)
        out = np.zeros((len(theta), 2, len(self.x)))
        out[:, :, :SIZE] = by_base
        for term, part, basis in self._parts(theta, situation):
            columns = _by_strength(term, by_base)
            if columns is not None:
                out[:, :, part] = columns[:, :, None] * basis[:, None, :]
        return out

    def _effects(self, theta: Real, situation: Situation) -> tuple[Real, Complex]:
        """Contributions of the effects: to joint angles (K, 2), rad, and through lengths to P (K,), mm."""
        turned, moved = np.zeros_like(theta), np.zeros(len(theta), dtype=complex)
        by_base: Real | None = None
        for term, part, basis in self._parts(theta, situation):
            strength = basis @ self.x[part]
            if term.acts.joint is not None:
                turned[:, term.acts.joint] += strength
            elif term.acts.lengths is not None:
                if by_base is None:
                    by_base = position_jacobian(self.geometry, pose(self.geometry, theta + self.x[:2]))
                columns = _by_strength(term, by_base)
                assert columns is not None
                moved += (columns[:, 0] + 1j * columns[:, 1]) * strength
        return turned, moved

    def _parts(self, theta: Real, situation: Situation) -> Sequence[tuple[Term, slice, Real]]:
        """Each term with its indices in x and its basis (K, q)."""
        if not self.terms:
            return ()
        c = self._conditions(theta, situation)
        start = len(self.x) - sum(term.size for term in self.terms)
        out = []
        for term in self.terms:
            out.append((term, slice(start, start + term.size), term.effect.at(term.hidden, c)))
            start += term.size
        return out

    def _conditions(self, theta: Real, situation: Situation) -> Conditions:
        at = pose(self.geometry, theta + self.x[:2])
        robot, unknown = self.robot, np.zeros(len(theta))
        return Conditions(
            t_s=np.full(len(theta), self.end_s),
            theta=theta + self.x[:2],
            drive_angle=theta - np.radians(robot.zero_at_deg),
            approach=situation.approach,
            travel=unknown,
            slider_direction=unknown,
            slider_by_joint=np.zeros_like(theta),
            slider_net=unknown,
            temperature_rise=situation.temperature_rise,
            payload_kg=situation.payload_kg,
            lengths=lengths(robot),
            pull=pull(at.w),
            load=load(theta + self.x[:2]),
        )


def identified(fit: Fit, sd_factor: float = 1.0) -> IdentifiedMachine | None:
    """The fitted machine, its covariance widened; None for an arm, which its own controller commands."""
    m = fit.model.mechanism
    if not isinstance(m, FiveBar):
        return None
    covariance = fit.solution.covariance * sd_factor**2
    return IdentifiedMachine(m.robot, fit.x, covariance, fit.model.terms, float(m.measurements.t_s.max()))


def _by_strength(term: Term, by_base: Real) -> Real | None:
    """(K, 2) d (x, y) per unit of a term's strength; None if it moves nothing."""
    if term.acts.joint is not None:
        return np.asarray(by_base[:, :, term.acts.joint])
    if term.acts.lengths is None:
        return None
    return np.asarray(sum(by_base[:, :, NAMES.index(name)] * mm for name, mm in term.acts.lengths.items()))
