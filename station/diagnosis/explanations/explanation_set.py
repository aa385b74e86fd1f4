"""The explanations of one set of readings: possible errors, their probabilities, and the consequences."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from station.diagnosis.explanations.cleaning import FAR_OFF, WELL_PREDICTED, judged, start, suspects
from station.diagnosis.explanations.family import Part
from station.diagnosis.explanations.frame import added, frame
from station.diagnosis.explanations.mixture import Mixture, PositionError, mixture
from station.diagnosis.explanations.noise_level import NoiseLevel, specified
from station.diagnosis.explanations.search import Key
from station.diagnosis.explanations.searched import with_searched
from station.diagnosis.explanations.settle import Settled, settle
from station.diagnosis.explanations.situation import Around, at_readings, predicted
from station.diagnosis.explanations.statements import Statements, statements
from station.diagnosis.explanations.validation import Validation, together, validate
from station.diagnosis.explanations.verdict import Decision, Finding, decide, findings, loudness, reported
from station.diagnosis.explanations.weighing import Weighing, weigh
from station.five_bar import SCALE_SD_MM, FiveBar
from station.mechanism import Reference, reference_of
from station.records import Complex, Measurements, Quantity, Real

SHOWN = 0.01
MOSTLY_BASE = 0.5
"""Probability of the base model above which it alone is validated."""
MOST_LATE = 0.05
"""Maximum share of readings that may be excluded after weighing."""


@dataclass(frozen=True)
class Held:
    """One error of an explanation."""

    part: Part
    parameters: tuple[Quantity, ...]
    kind: str
    depends_on: str | None
    """The quantity that an unnamed error depends on."""


@dataclass(frozen=True)
class Explanation:
    """A set of errors that would account for the readings; the empty set is the base model."""

    errors: tuple[Held, ...]
    probability: float
    named: bool


@dataclass(frozen=True)
class ExplanationSet:
    """All results from one set of readings and, where there are any, fresh ones."""

    mechanism: FiveBar
    """The mechanism with all readings that were used."""
    weighing: Weighing
    statements: Statements
    validation: Validation | None
    findings: tuple[Finding, ...]
    decision: Decision
    outliers: tuple[int | str, ...]
    """Excluded readings."""

    @cached_property
    def mixture(self) -> Mixture:
        """The numbers of the set."""
        weighed = [(w.settled, w.probability) for w in self.weighing.settled]
        return mixture(self.mechanism, self.weighing.frame.situation, weighed)

    @cached_property
    def explanations(self) -> tuple[Explanation, ...]:
        """All explanations with a probability of 0.01 or more, most probable first."""
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
        """Position error of the mixture over the workspace: with the base model's and its own commands."""
        return self.mixture.before_and_after(self.base)

    @property
    def base(self) -> Settled:
        """The base model alone."""
        return self.weighing.by_key[()]

    def commands(self, place: Complex, approach: Real | None = None) -> Real:
        """(G, 2) joint commands, rad, for positions (G,), mm: best on average over the set."""
        return self.mixture.commands(place, None if approach is None else Around(approach))

    def probability(self, effect: str, joint: int | None, part: str | None = None) -> float:
        """Probability that an effect is present: the sum over all explanations that contain it."""
        return self.statements.probability((effect, joint, part))

    @property
    def loudness(self) -> float:
        """Noise under the best explanation, over the specification."""
        return loudness(self.weighing.best, self.weighing)

    def left_by(self, mechanism: FiveBar) -> tuple[Real, Real]:
        """(K,) residual of other readings under the best explanation, and their noise, mm."""
        best = self.weighing.best
        p = best.x[: best.size]
        more = added(at_readings(mechanism, p, self.weighing.reference), best.present)
        sd = specified_as(self.weighing, mechanism) * best.level
        return mechanism.measured - predicted(mechanism, p, more), sd

    @cached_property
    def shown(self) -> Settled:
        """The reported explanation: that of the findings, otherwise the most probable one with any error."""
        return self.weighing.settle(reported(self.statements) or self.statements.cores[0][0])

    def held(self, settled: Settled, at: int) -> tuple[Held, ...]:
        """One error of an explanation by its number, part by part."""
        family, choice, where = settled.families[at], settled.choices[at], settled.parts[at]
        amplitudes, covariance = settled.amplitudes[at], settled.covariance[where, where]
        hidden = family.hidden[choice.member]
        out = []
        for part in family.parts:
            own = list(part.own)
            quantities = part.quantities(hidden, amplitudes[own], covariance[np.ix_(own, own)])
            quantities = with_searched(self.weighing.frame, settled, at, quantities)
            out.append(Held(part, quantities, family.kind, family.depends_on))
        return tuple(out)

    def _explanation(self, key: Key, probability: float) -> Explanation:
        settled = self.weighing.settle(key)
        held = [one for k in range(len(settled.families)) for one in self.held(settled, k)]
        return Explanation(tuple(held), probability, self.statements.named(key))


def explain(mechanism: FiveBar, fresh: Measurements | None = None) -> ExplanationSet:
    """Explain the readings of a mechanism; fresh readings first serve as a test, then are included.

    :raises NotConvergedError: the base model cannot be fitted, even without glitches.
    :raises InputRefused: fresh readings belong to a mount that the others do not have.
    """
    measurements = mechanism.measurements
    reference = reference_of(measurements)
    both = mechanism if fresh is None else mechanism.of(together(measurements, fresh))
    weighing = _weighed(both, reference)
    said = statements(weighing)
    validation = None
    if fresh is not None:
        plain = said.base >= MOSTLY_BASE
        validation = _validated(both, reference, len(measurements), weighing, plain)
    named = findings(said)
    held = set(weighing.mechanism.measurements.ids)
    return ExplanationSet(
        weighing.mechanism, weighing, said, validation, named, decide(said, named, validation),
        tuple(i for i in both.measurements.ids if i not in held),
    )  # fmt: skip


def _weighed(mechanism: FiveBar, reference: Reference) -> Weighing:
    """Explanations of the readings without glitches, which disagree with all others or with the best
    explanation.

    A reading that looked like a glitch and is predicted well by the result is taken back.
    """
    measurements = mechanism.measurements
    out = suspects(mechanism, reference)
    weighing = _once(mechanism.of(measurements.take(~out)) if out.any() else mechanism, reference)
    off = judged(mechanism, reference, weighing.best, specified_as(weighing, mechanism))
    again = np.where(out, off > WELL_PREDICTED, off > FAR_OFF)
    if (again == out).all() or again.sum() > out.sum() + MOST_LATE * len(out):
        return weighing
    return _once(mechanism.of(measurements.take(~again)), reference)


def _once(mechanism: FiveBar, reference: Reference) -> Weighing:
    p, residual_mm = start(mechanism, reference)
    return weigh(mechanism, p, reference, specified(mechanism, residual_mm))


def _validated(
    both: FiveBar, reference: Reference, earlier: int, weighing: Weighing, plain: bool
) -> Validation:
    """Compare the fresh readings, which follow `earlier` others, with the prediction of those others alone.

    Where the base model is adequate (`plain`) it is fitted to them without a search. Any other explanation is
    searched for again without the fresh readings, linearised about the best explanation of all readings.
    """
    held = set(weighing.mechanism.measurements.ids)
    rows = np.array([i in held for i in both.measurements.ids])
    order = np.arange(len(rows))
    first = both.of(both.measurements.take(order[rows & (order < earlier)]))
    fresh = both.measurements.take(order >= earlier)
    row_sd = specified_as(weighing, both)
    best = weighing.best
    p = best.x[: best.size]
    present = () if weighing.wanders else best.present
    if plain:
        base = frame(first, p, reference, row_sd[:earlier][rows[:earlier]])
        noise_level = NoiseLevel(len(first.measurements), base.parameters_taken)
        weighed = [(settle(base, (), (), noise_level, reference), 1.0)]
    else:
        found = weigh(first, p, reference, row_sd[:earlier][rows[:earlier]], weighing.bank.families, present)
        weighed = [(w.settled, w.probability) for w in found.settled if w.probability >= SHOWN]
    return validate(first, reference, weighed, fresh, row_sd[earlier:])


def specified_as(weighing: Weighing, mechanism: FiveBar) -> Real:
    """(K,) specified noise of other readings of the same kind as those weighed, mm."""
    if np.array_equal(weighing.frame.row_sd, weighing.mechanism.row_sd):
        return mechanism.row_sd
    return np.asarray(SCALE_SD_MM / np.sqrt(mechanism.measurements.samples))
