"""The models on the way to one explanation: the base model, then its errors one by one, strongest first.

They are fitted to the earlier readings only, so that fresh readings are predicted with all parameters fixed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from station.diagnosis.explanations.evidence import Choice
from station.diagnosis.explanations.explanation_set import ExplanationSet, Held, specified_as
from station.diagnosis.explanations.frame import added, frame
from station.diagnosis.explanations.noise_level import NoiseLevel
from station.diagnosis.explanations.settle import Settled, settle
from station.diagnosis.explanations.situation import Situation, at_readings, predicted
from station.diagnosis.explanations.validation import prediction
from station.fitting import Solution
from station.five_bar import FiveBar
from station.records import Measurements, Real

OPEN = 4.0
"""Standard deviation of a prediction over the noise above which it is meaningless."""


@dataclass(frozen=True)
class Step:
    """One model, fitted."""

    settled: Settled
    errors: tuple[Held, ...]
    """Its errors beyond those of the previous step; empty for the base model."""
    situation: Situation
    solution: Solution
    """Residual and derivatives over the noise under this model."""
    row_sd: Real
    """(K,) that noise, mm."""
    fresh_mm: Real | None
    """(F,) fresh readings less predicted; NaN where the model does not determine the prediction."""

    @property
    def residual_mm(self) -> Real:
        """(K,) measured less predicted."""
        return -self.solution.residual * self.row_sd


def steps(found: ExplanationSet, earlier: Measurements, fresh: Measurements | None) -> tuple[Step, ...]:
    """From the base model to the reported explanation, with the readings that were used."""
    mechanism = found.mechanism.of(earlier)
    later = None if fresh is None else found.mechanism.of(fresh)
    left = list(found.shown.choices) if found.decision.verdict != "adequate" else []
    out = [_step(found, mechanism, later, (), ())]
    taken: tuple[Choice, ...] = ()
    while left:
        tries = [_settled(found, mechanism, (*taken, choice)) for choice in left]
        best = int(np.argmin([one.cost for one in tries]))
        choice = left.pop(best)
        taken = (*taken, choice)
        out.append(_step(found, mechanism, later, taken, _held(found, choice), tries[best]))
    return tuple(out)


def _held(found: ExplanationSet, choice: Choice) -> tuple[Held, ...]:
    """The name of an error, with its sizes in the explanation that all readings support."""
    at = found.shown.choices.index(choice)
    return found.held(found.shown, at)


def _settled(found: ExplanationSet, mechanism: FiveBar, choices: Sequence[Choice]) -> Settled:
    weighing = found.weighing
    best, count = found.shown, len(choices)
    present = tuple(p for p, c in zip(best.present, best.choices, strict=True) if c in choices)
    p = best.x[: best.size] if count == len(best.choices) else weighing.start
    at = frame(mechanism, p, weighing.reference, specified_as(weighing, mechanism), present if count else ())
    noise = NoiseLevel(len(at.row_sd), at.parameters_taken)
    return settle(at, weighing.families, tuple(choices), noise, weighing.reference)


def _step(
    found: ExplanationSet,
    mechanism: FiveBar,
    later: FiveBar | None,
    choices: tuple[Choice, ...],
    errors: tuple[Held, ...],
    settled: Settled | None = None,
) -> Step:
    weighing = found.weighing
    one = settled or _settled(found, mechanism, choices)
    p = one.x[: one.size]
    plain = at_readings(mechanism, p, weighing.reference)
    more = added(plain, one.present)
    s = plain if more is None else at_readings(mechanism, p, weighing.reference, more)
    columns = [f.columns(s, c.member)[0] for f, c in zip(one.families, one.choices, strict=True)]
    row_sd = specified_as(weighing, mechanism) * one.level
    nothing = np.zeros(0)
    solution = Solution(
        x=one.x,
        covariance=one.covariance,
        singular_values=nothing,
        directions=nothing,
        scale=nothing,
        cost=one.cost,
        residual=(predicted(mechanism, p, more) - mechanism.measured) / row_sd,
        jacobian=np.hstack([s.by_parameter[:, 0, :], *columns]) / row_sd[:, None],
        steps=0,
    )
    fresh_mm = None
    if later is not None:
        sd = specified_as(weighing, later)
        fresh_mm, covariance = prediction(later, weighing.reference, one, sd)
        fresh_mm = np.where(np.sqrt(np.diag(covariance)) > OPEN * sd * one.level, np.nan, fresh_mm)
    return Step(one, errors, s, solution, row_sd, fresh_mm)
