"""The decision: the verdict, whether it is confirmed, and the named effects (contract.md, second form)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.explanations.family import Part
from station.diagnosis.explanations.frame import added
from station.diagnosis.explanations.search import Key
from station.diagnosis.explanations.settle import Settled
from station.diagnosis.explanations.situation import predicted
from station.diagnosis.explanations.statements import PartKey, Statements
from station.diagnosis.explanations.validation import Validation
from station.diagnosis.explanations.weighing import Weighing
from station.fitting import FEWEST_REPEATS, pure_error
from station.records import Quantity

Verdict = Literal["adequate", "explained", "ambiguous", "partly_explained", "unexplained"]
SURE = 0.95
"""Minimum probability of each named effect including its aliases,"""
UNNAMED = 0.03
"""and maximum probability of an unnamed error."""
MISFIT_P = 1e-5
LOUD = 2.0
"""Noise over the specification above which it no longer counts as noise."""
MOSTLY = 0.5
REPORTED = 0.01
"""Probability below which an explanation is not reported."""


@dataclass(frozen=True)
class Finding:
    """A named effect of the most probable explanation."""

    part: Part
    parameters: tuple[Quantity, ...]
    probability: float
    """Sum over all explanations that contain it or one of its aliases."""
    alias_set: tuple[PartKey, ...]


@dataclass(frozen=True)
class Decision:
    """The verdict and its basis."""

    verdict: Verdict
    confirmed: bool | None
    """None without fresh readings."""
    accounted: bool
    """Whether the best explanation leaves only noise."""


def accounts(weighed: Settled, statements: Statements) -> bool:
    """Whether an explanation leaves no more than the scatter of the repeats, and that is noise."""
    weighing = statements.weighing
    frame, measurements = weighing.frame, weighing.mechanism.measurements
    if loudness(weighed, weighing) > LOUD:
        return False
    model = predicted(weighing.mechanism, weighed.x[: weighed.size], added(frame.situation, weighed.present))
    residual = (weighing.mechanism.measured - model) / frame.row_sd
    pure, dof = pure_error(measurements, residual)
    # the prior is a part of the cost: amplitudes and parameters use up as many readings as they are worth
    lack_dof = len(residual) - dof - frame.parameters_taken
    if dof < FEWEST_REPEATS or pure == 0.0 or lack_dof < 1.0:
        return True
    lack = max(weighed.cost - pure, 0.0) / lack_dof
    return float(fdtrc(lack_dof, dof, lack / (pure / dof))) > MISFIT_P


def loudness(weighed: Settled, weighing: Weighing) -> float:
    """Noise under an explanation, over that of the head and of the feedback's half pulse.

    A random drift is weighed by the noise of the head alone; it counts as too large only beyond both.
    """
    specified = np.maximum(weighing.frame.row_sd, weighing.mechanism.row_sd)
    return weighed.level * float(np.sqrt(np.mean(weighing.frame.row_sd**2) / np.mean(specified**2)))


def decide(statements: Statements, findings: tuple[Finding, ...], validation: Validation | None) -> Decision:
    """The verdict from the probabilities; nothing is confirmed without independent fresh readings."""
    best = statements.weighing.best
    accounted = accounts(best, statements)
    if accounted and statements.base >= max((p for key, p in statements.cores if key), default=0.0):
        agreed = None if validation is None else validation.agrees and validation.independent
        refuted = validation is not None and validation.new and not validation.agrees
        return Decision("unexplained" if refuted else "adequate", agreed, accounted)
    sure = (
        accounted
        and bool(findings)
        and all(f.probability >= SURE for f in findings)
        and statements.unnamed < UNNAMED
    )
    if validation is None:
        confirmed: bool | None = None
    else:
        confirmed = sure and validation.independent and validation.agrees
    refuted = validation is not None and validation.new and not validation.agrees
    if sure and not refuted:
        return Decision("explained", confirmed, accounted)
    if refuted or statements.unnamed >= MOSTLY:
        partly = not refuted and any(f.probability >= SURE for f in findings)
        return Decision("partly_explained" if partly else "unexplained", confirmed, accounted)
    if accounted:
        return Decision("ambiguous", confirmed, accounted)
    partly = any(f.probability >= SURE for f in findings)
    return Decision("partly_explained" if partly else "unexplained", confirmed, accounted)


def reported(statements: Statements) -> Key | None:
    """The reported core: the most probable one with a named effect, otherwise with any error."""
    families = statements.weighing.families
    cores = [key for key, _ in statements.cores if key]
    named = (key for key, p in statements.cores if p >= REPORTED and any(families[k].named for k in key))
    return next(named, cores[0] if cores else None)


def findings(statements: Statements) -> tuple[Finding, ...]:
    """The named effects of the most probable core that contains any."""
    weighing = statements.weighing
    core = reported(statements)
    if core is None or statements.base >= MOSTLY or not any(weighing.families[k].named for k in core):
        return ()
    settled = weighing.settle(core)
    out = []
    for index, (family, choice, amplitudes, where) in enumerate(
        zip(settled.families, settled.choices, settled.amplitudes, settled.parts, strict=True)
    ):
        if not family.named:
            continue
        alike = tuple(
            k
            for k in statements.aliases(settled.choices, index)
            # one half of a natural pair is not an alternative name of the pair
            if not _nested(family.keys, weighing.families[k].keys)
        )
        alias_keys = tuple(sorted(set().union(*(weighing.families[k].keys for k in alike)), key=str))
        covariance = settled.covariance[where, where]
        for part in family.parts:
            own = list(part.own)
            out.append(
                Finding(
                    part,
                    part.quantities(
                        family.hidden[choice.member], amplitudes[own], covariance[np.ix_(own, own)]
                    ),
                    statements.probability(part.key, alike),
                    tuple(key for key in alias_keys if key not in family.keys),
                )
            )
    return tuple(out)


def _nested(a: frozenset[PartKey], b: frozenset[PartKey]) -> bool:
    return a <= b or b <= a
