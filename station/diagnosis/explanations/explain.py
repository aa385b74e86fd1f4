"""The explanations of one set of readings: what may be wrong with the robot, how probable, and what follows."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from station import noise
from station.conditions import Reference, reference_of
from station.diagnosis.explanations.cleaning import FAR_OFF, WELL_PREDICTED, Mask, judged, solved, suspects
from station.diagnosis.explanations.family import Part
from station.diagnosis.explanations.mixture import Mixture, PositionError, mixture
from station.diagnosis.explanations.noise_level import specified
from station.diagnosis.explanations.search import Key
from station.diagnosis.explanations.statements import Statements, statements
from station.diagnosis.explanations.validation import Validation, together, validate
from station.diagnosis.explanations.verdict import Decision, Finding, decide, findings
from station.diagnosis.explanations.weighing import Weighing, weigh
from station.five_bar import FiveBar
from station.kinematics import Complex, Real
from station.measurements import Measurements
from station.records import Quantity

SHOWN = 0.01
MOST_LATE = 0.05
"""Share of readings that may be left out after weighing."""


@dataclass(frozen=True)
class Held:
    """One error of an explanation."""

    part: Part
    parameters: tuple[Quantity, ...]
    kind: str
    depends_on: str | None
    """Of an unnamed one."""


@dataclass(frozen=True)
class Explanation:
    """A set of errors that would account for the readings; none of them: the base model."""

    errors: tuple[Held, ...]
    probability: float
    named: bool


@dataclass(frozen=True)
class ExplanationSet:
    """Everything that follows from one set of readings and, where there are any, fresh ones."""

    mechanism: FiveBar
    """With all readings that took part."""
    weighing: Weighing
    statements: Statements
    validation: Validation | None
    findings: tuple[Finding, ...]
    decision: Decision
    outliers: tuple[int | str, ...]
    """Readings left out."""

    @cached_property
    def mixture(self) -> Mixture:
        """The numbers of the set."""
        weighed = [(w.settled, w.probability) for w in self.weighing.settled]
        return mixture(self.mechanism, self.weighing.frame.situation, weighed)

    @cached_property
    def explanations(self) -> tuple[Explanation, ...]:
        """Every one with a probability of 0.01 or more, most probable first."""
        return tuple(self._explanation(key, p) for key, p in self.statements.cores if p >= SHOWN)

    @cached_property
    def parameters(self) -> tuple[Quantity, ...]:
        """Base parameters of the mixture."""
        mean, sd = self.mixture.mean, np.sqrt(np.diag(self.mixture.covariance))
        return tuple(
            Quantity(p.name, float(x * p.shown), float(s * p.shown), p.unit)
            for p, x, s in zip(self.mechanism.parameters, mean, sd, strict=True)
        )

    @cached_property
    def position_error(self) -> tuple[PositionError, PositionError]:
        """Predicted over the workspace, before and after, of the mixture."""
        return self.mixture.before_and_after()

    def commands(self, place: Complex, approach: Real | None = None) -> Real:
        """(G, 2) joint commands, rad, for places (G,), mm: best on average over the set."""
        return self.mixture.commands(place, approach)

    def probability(self, effect: str, joint: int | None, part: str | None = None) -> float:
        """That an effect is there: the sum over all explanations that hold it."""
        return self.statements.probability((effect, joint, part))

    def _explanation(self, key: Key, probability: float) -> Explanation:
        settled = self.weighing.settle(key)
        held = []
        for family, choice, amplitudes, where in zip(
            settled.families, settled.choices, settled.amplitudes, settled.parts, strict=True
        ):
            covariance = settled.covariance[where, where]
            hidden = family.hidden[choice.member]
            for part in family.parts:
                own = list(part.own)
                quantities = part.quantities(hidden, amplitudes[own], covariance[np.ix_(own, own)])
                held.append(Held(part, quantities, family.kind, family.depends_on))
        return Explanation(tuple(held), probability, self.statements.named(key))


def explain(mechanism: FiveBar, fresh: Measurements | None = None) -> ExplanationSet:
    """Explain the readings of a mechanism; fresh ones first test, then take part.

    :raises NotConvergedError: the base model cannot be fitted, even without glitches.
    :raises InputRefused: fresh readings of a mount that the others do not have.
    """
    reference = reference_of(mechanism.measurements)
    out = suspects(mechanism, reference)
    first = mechanism.of(mechanism.measurements.take(~out))
    both = first if fresh is None else mechanism.of(together(first.measurements, fresh))
    weighing, late = _weighed(both, reference)
    lost = [i for i, off in zip(mechanism.measurements.ids, out, strict=True) if off]
    lost += [i for i, off in zip(both.measurements.ids, late, strict=True) if off]
    said = statements(weighing)
    validation = None if fresh is None else _validated(first, reference, fresh, weighing)
    named = findings(said)
    return ExplanationSet(
        weighing.mechanism, weighing, said, validation, named, decide(said, named, validation), tuple(lost)
    )


def _weighed(mechanism: FiveBar, reference: Reference) -> tuple[Weighing, Mask]:
    """Explanations of readings, once more without those that are far off the best one."""
    weighing = _once(mechanism, reference)
    off = judged(mechanism, reference, weighing.best, weighing.frame.row_sd) > FAR_OFF
    if not off.any() or off.sum() > MOST_LATE * len(off):
        return weighing, np.zeros(len(off), dtype=bool)
    return _once(mechanism.of(mechanism.measurements.take(~off)), reference), off


def _once(mechanism: FiveBar, reference: Reference) -> Weighing:
    start = solved(mechanism, reference, mechanism.row_sd)
    row_sd = specified(mechanism, -start.residual * mechanism.row_sd)
    return weigh(mechanism, start.x, reference, row_sd)


def _validated(first: FiveBar, reference: Reference, fresh: Measurements, weighing: Weighing) -> Validation:
    """Fresh readings against what the earlier ones alone say.

    The base model needs no search; anything else is searched for without the fresh readings.
    """
    earlier = _once(first, reference)
    weighed = [(w.settled, w.probability) for w in earlier.settled if w.probability >= SHOWN]
    fresh = together(first.measurements, fresh).take(np.arange(len(first.measurements), len(first.measurements) + len(fresh)))
    later = first.of(fresh)
    row_sd = _fresh_sd(earlier, later)
    return validate(first, reference, weighed, fresh, row_sd)


def _fresh_sd(earlier: Weighing, later: FiveBar) -> Real:
    """(F,) specified noise of fresh readings, of the kind that the earlier ones have."""
    kind = earlier.mechanism.row_sd
    if np.array_equal(earlier.frame.row_sd, kind):
        return later.row_sd
    return specified(later, np.zeros(len(later.measurements)))
