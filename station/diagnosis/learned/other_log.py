"""Effects learned on one log, applied unchanged to another: a test that they belong to the machine.

The position of the machine and its tool may differ, so the parameters of the mechanism are fitted again, on
three quarters of the new readings at a time; the effects stay as learned. Everything is judged by the
remaining quarter, once without the effects and once with them. A curve is not applied where its joint was not
learned.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis.learned.model_file import terms_of
from station.diagnosis.tests_of_fit import folds
from station.errors import InputRefused
from station.fitting import (
    NotConvergedError,
    Outlier,
    Solution,
    few_enough,
    find_outliers,
    solve,
    tolerance_prior,
)
from station.machines import AnyMechanism, AnyRobot, effects_of, mechanism_of
from station.mechanism import Reference, by_reading
from station.model import Model, Term
from station.records import Flags, Measurements, MixtureDocument, ModelDocument, Real, inside_visited

FEWEST_AN_UNKNOWN = 4
DETERMINED = 2.0
"""Uncertainty of a pose over the residual's scatter, above which other readings do not determine it."""


@dataclass(frozen=True, slots=True)
class Errors:
    """Errors of readings that were not used in the fit, mm."""

    rms_mm: float
    median_mm: float
    max_mm: float


@dataclass(frozen=True)
class Transfer:
    """The benefit of one log's effects for another."""

    readings: int
    outliers: tuple[Outlier, ...]
    """Readings so far off that no model of this machine predicts them; excluded from everything below."""
    inside: int
    """Number of readings within the learned range of every joint with an effect."""
    effects: tuple[str, ...]
    determined: int
    """Number of those that the other readings determine; the errors are over these."""
    alone: Errors
    """The mechanism alone, for the readings inside."""
    applied: Errors
    """With the effects, the same readings."""
    beyond: tuple[Errors, Errors] | None
    """The same pair within the outer limits of the learned range, gaps included; None if empty."""


def transfer(
    part: ModelDocument | MixtureDocument, robot: AnyRobot, readings: Measurements, source: str
) -> Transfer:
    """Apply the effects of a learned model to readings of the same machine.

    :raises InputRefused: there is nothing to apply, or there are too few readings inside the learned range.
    """
    if isinstance(part, MixtureDocument):
        raise InputRefused(
            f"Model {source} holds the explanations of a five-bar; only the effects of an arm are applied to "
            "another log. Diagnose the other log, or use `station solve`."
        )
    readings = _turned_near(part, readings)
    mechanism = mechanism_of(robot, readings)
    mechanism.check()
    terms = terms_of(part, effects_of(mechanism), source)
    if not terms:
        raise InputRefused(f"Model {source} has no effects: there is nothing to apply.")
    joints = sorted({t.acts.joint for t in terms if t.acts.joint is not None})
    inside = np.ones(len(readings), dtype=bool)
    within = inside.copy()
    for i in joints:
        inside &= _been(part, readings, i)
        low, high = np.radians(part.ranges.joints_deg[i])
        within &= (readings.theta[:, i] >= low) & (readings.theta[:, i] <= high)
    needed = FEWEST_AN_UNKNOWN * len(mechanism.parameters)
    if inside.sum() < needed:
        raise InputRefused(
            f"Only {int(inside.sum())} of {len(readings)} readings are in the joint ranges of the "
            f"learned effects; {needed} are needed to evaluate them."
        )
    off = _off(mechanism.of(readings.take(inside)), terms, part)
    named = {o.reading for o in off}
    sound = np.array([i not in named for i in readings.ids])
    alone, applied, determined = _both(mechanism, terms, part, inside & sound)
    beyond = None if (inside == within).all() else _both(mechanism, terms, part, within & sound)[:2]
    labels = tuple(t.effect.label for t in terms)
    return Transfer(
        len(readings), off, int((inside & sound).sum()), labels, determined, alone, applied, beyond
    )


def _turned_near(part: ModelDocument, readings: Measurements) -> Measurements:
    """The same poses, each joint moved by whole turns to be nearest to the middle of its learned range."""
    middle = np.radians([(low + high) / 2.0 for low, high in part.ranges.joints_deg])
    turns = np.round((readings.theta - middle) / (2.0 * np.pi))
    return replace(readings, theta=readings.theta - 2.0 * np.pi * turns)


def _been(part: ModelDocument, readings: Measurements, joint: int) -> Flags:
    """(K,) whether a joint (index) is within the range visited when the model was learned."""
    stretches = [(np.radians(a), np.radians(b)) for a, b in part.ranges.visited_deg[joint]]
    return inside_visited(readings.theta[:, [joint]], [stretches])


def _off(mechanism: AnyMechanism, terms: tuple[Term, ...], part: ModelDocument) -> tuple[Outlier, ...]:
    frozen = _Frozen(mechanism, terms, part)
    found = find_outliers(mechanism, frozen.solved, mechanism.row_sd)
    return found if few_enough(found, len(mechanism.measurements)) else ()


def _both(
    mechanism: AnyMechanism, terms: tuple[Term, ...], part: ModelDocument, chosen: Flags
) -> tuple[Errors, Errors, int]:
    """Errors without and with the terms, over poses that both fits determine, and the number of those."""
    some = mechanism.of(mechanism.measurements.take(chosen))
    (alone, sure), (applied, sure_too) = _held_out(some, (), part), _held_out(some, terms, part)
    both = sure & sure_too
    if not both.any():
        raise InputRefused(
            "No reading is predicted by the others better than the model fits: tool and base of this log "
            "cannot be told from its readings; measure with other orientations of the wrist."
        )
    return _errors(alone[both]), _errors(applied[both]), int(both.sum())


def _errors(mm: Real) -> Errors:
    return Errors(float(np.sqrt(np.mean(mm**2))), float(np.median(mm)), float(mm.max()))


def _held_out(mechanism: AnyMechanism, terms: tuple[Term, ...], part: ModelDocument) -> tuple[Real, Flags]:
    """(K,) mm, each fold predicted by the mechanism fitted to the others, terms fixed; whether determined.

    A pose with a wrist orientation that no other reading has is not determined: it alone shows the position
    of the tool in that direction.
    """
    m = mechanism.measurements
    fold = folds(m)
    error, sure = np.empty(len(m)), np.zeros(len(m), dtype=bool)
    for f in np.unique(fold):
        learned = _Frozen(mechanism.of(m.take(fold != f)), terms, part)
        out = _Frozen(mechanism.of(m.take(fold == f)), terms, part)
        found = learned.solved(learned.mechanism.row_sd)
        scatter = found.cost / len(found.residual)
        unknown = out.unknown(found) * np.sqrt(max(scatter, 1.0))
        typical = np.sqrt(scatter) * float(learned.mechanism.row_sd[0])
        error[fold == f] = out.errors(found.x)
        sure[fold == f] = unknown < DETERMINED * typical
    return error, sure


class _Frozen:
    """A mechanism with effects that are not fitted."""

    def __init__(self, mechanism: AnyMechanism, terms: tuple[Term, ...], part: ModelDocument) -> None:
        m = mechanism.measurements
        reference = Reference(part.reference.temperature_c, m.theta[-1], float(m.distance[-1]))
        self.mechanism = mechanism
        self.model = Model(mechanism, reference, terms)
        self.amplitudes = np.array([a for term in part.terms for a in term.amplitudes] if terms else [])
        learned = dict(zip(part.names, part.values, strict=True))
        start = mechanism.start
        p = np.array(
            [learned.get(q.name, x) for q, x in zip(mechanism.parameters, start, strict=True)], dtype=float
        )
        bases = self.model.bases(self.model.conditions(p, first=False))
        self.bases = [
            basis * _been(part, m, term.acts.joint)[:, None]
            if term.effect.local and term.acts.joint is not None
            else basis
            for term, basis in zip(terms, bases, strict=True)
        ]

    def solved(self, sd: Real) -> Solution:
        """The fit with rows that scatter by sd (R,).  :raises InputRefused: the fit does not converge."""
        size = self.model.base_size

        def residuals(p: Real) -> tuple[Real, Real]:
            at = self.model.observe(np.concatenate([p, self.amplitudes]), self.bases)
            return (at.value - self.mechanism.measured) / sd, at.by_parameter[:, :size] / sd[:, None]

        try:
            return solve(residuals, self.mechanism.start, tolerance_prior(self.mechanism))
        except NotConvergedError as error:
            raise InputRefused(
                f"The mechanism does not converge on these readings ({error}); are they of the same machine?"
            ) from error

    def unknown(self, learned: Solution) -> Real:
        """(K,) mm, standard uncertainty of the target's position, for a mechanism from other readings."""
        at = self.model.observe(np.concatenate([learned.x, self.amplitudes]), self.bases)
        J = at.by_parameter[:, : self.model.base_size]
        return by_reading(
            self.mechanism, np.sqrt(np.maximum(np.einsum("ki,ki->k", J @ learned.covariance, J), 0.0))
        )

    def errors(self, p: Real) -> Real:
        """(K,) mm"""
        at = self.model.observe(np.concatenate([p, self.amplitudes]), self.bases)
        return by_reading(self.mechanism, at.value - self.mechanism.measured)
