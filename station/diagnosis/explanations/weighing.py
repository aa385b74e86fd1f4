"""All explanations of one set of readings with their probabilities: search, settle, linearise again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy.special import logsumexp

from station.diagnosis.explanations.catalogue import catalogue
from station.diagnosis.explanations.evidence import Bank, Choice
from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.frame import Frame, Present, frame
from station.diagnosis.explanations.noise_level import NoiseLevel
from station.diagnosis.explanations.search import BY_COUNT, Candidate, Key, Search
from station.diagnosis.explanations.settle import Settled, settle
from station.diagnosis.explanations.smooth_processes import wanderings
from station.five_bar import FiveBar, lengths
from station.mechanism import Reference
from station.records import Real

MOST_SETTLED = 12
SETTLED_WITHIN = 4.5
"""Log of probability below the best within which an explanation is settled."""
ANEW = 1.0
"""Standard deviations between model and tangent above which everything is linearised again."""
RESTLESS = 1.5
"""Noise over the specification, under everything else, above which a random step per reading is tried."""
ROUNDS = 3


@dataclass(frozen=True)
class Weighed:
    """One explanation and its share of the probability."""

    settled: Settled
    log_posterior: float
    probability: float


@dataclass(frozen=True)
class Weighing:
    """The probabilities of all explanations, given the readings."""

    mechanism: FiveBar
    reference: Reference
    start: Real
    """(P,) base parameters at which the families were made."""
    families: tuple[Family, ...]
    frame: Frame
    bank: Bank
    candidates: dict[Key, Candidate]
    """All evaluated candidates."""
    log_posterior: dict[Key, float]
    """Absolute, up to a constant of the readings; settled explanations have their settled value."""
    settled: tuple[Weighed, ...]
    """Most probable first; probabilities among themselves."""
    by_key: dict[Key, Settled]

    @property
    def best(self) -> Settled:
        return self.settled[0].settled

    @property
    def wanders(self) -> bool:
        """Whether the best explanation has a random step at every reading; the search does not contain it."""
        return any(c.family >= len(self.bank.families) for c in self.best.choices)

    def settle(self, key: Key) -> Settled:
        """One explanation by its families, settled now if it was not yet."""
        if key not in self.by_key:
            choices = self.candidates[key].choices
            self.by_key[key] = settle(self.frame, self.families, choices, self.bank.noise, self.reference)
        return self.by_key[key]


def weigh(
    mechanism: FiveBar,
    p: Real,
    reference: Reference,
    row_sd: Real,
    families: Sequence[Family] = (),
    present: Sequence[Present] = (),
) -> Weighing:
    """Explanations of the readings of `mechanism`, linearised at base parameters p (P,) first.

    With `present` errors the first tangent includes them, also at p.
    """
    at = frame(mechanism, p, reference, row_sd)
    if not families:
        recorded = mechanism.measurements.temperature_c is not None
        families = catalogue(at.situation, lengths(mechanism.robot), thermometer=recorded)
    families = tuple(families)
    noise = NoiseLevel(len(row_sd), at.parameters_taken)
    base = settle(at, families, (), noise, reference)
    if present:
        at = frame(mechanism, p, reference, row_sd, present)
    out: Weighing | None = None
    for _ in range(ROUNDS):
        bank = Bank(at, families, noise)
        search = Search(bank)
        if out is None and not at.present:
            start = search.first()
            if start.choices:
                single = settle(at, bank.families, start.choices, noise, reference)
                if ANEW < single.bend < np.inf:
                    families = tuple(bank.families)
                    at = frame(mechanism, single.x[: single.size], reference, row_sd, single.present)
                    bank = Bank(at, families, noise)
                    search = Search(bank)
        found = search.run([out.best.choices] if out is not None and out.best.choices else ())
        families = tuple(bank.families)
        out = _weighed(mechanism, p, families, bank, found, base, reference)
        best = out.best
        if best.bend < ANEW or not best.choices or out.wanders:
            break
        at = frame(mechanism, best.x[: best.size], reference, row_sd, best.present)
    assert out is not None
    return out


def _weighed(
    mechanism: FiveBar,
    start: Real,
    families: Sequence[Family],
    bank: Bank,
    found: Sequence[Candidate],
    base: Settled,
    reference: Reference,
) -> Weighing:
    """Settle the most probable, and bring all to one scale: the base model's evidence in this frame."""
    at, noise = bank.frame, bank.noise
    level = settle_base(bank)
    posterior = {c.key: c.log_posterior + level for c in found}
    settled: dict[Key, Settled] = {}
    bent: dict[Key, float] = {}
    candidates = {c.key: c for c in found}
    # use settled values: the tangent's value of the first may be far from true, and a later one the best
    top = -np.inf
    for c in found[:MOST_SETTLED]:
        if c.log_posterior + level < top - SETTLED_WITHIN:
            break
        one = base if not c.choices else settle(at, families, c.choices, noise, reference)
        if one.impossible:
            del posterior[c.key]
            continue
        taken = bank.known(c.choices)
        bent[c.key] = one.log_evidence + taken.sign - bank.log_evidence(taken) - level
        posterior[c.key] += bent[c.key]
        top = max(top, posterior[c.key])
        settled[c.key] = one
    for key in posterior.keys() - settled.keys():
        posterior[key] += _bent_as(key, bent)
    if () not in settled:
        settled[()] = base
        posterior[()] += base.log_evidence - level
    if settled[max(settled, key=lambda key: posterior[key])].level > RESTLESS:
        families = (*families, *wanderings(at.situation))
        for index in range(len(bank.families), len(families)):
            c, one = _wandering(at, families, index, noise, reference)
            candidates[c.key], settled[c.key] = c, one
            posterior[c.key] = c.log_posterior
    # only settled ones: the others use the tangent, which may promise far too much
    total = float(logsumexp([posterior[key] for key in settled]))
    order = sorted(settled, key=lambda key: -posterior[key])
    return Weighing(
        mechanism,
        reference,
        start,
        tuple(families),
        at,
        bank,
        candidates,
        posterior,
        tuple(Weighed(settled[key], posterior[key], float(np.exp(posterior[key] - total))) for key in order),
        settled,
    )


def _bent_as(key: Key, bent: Mapping[Key, float]) -> float:
    """Settled less tangent's log evidence of the largest settled part of a set that was not settled itself.

    Of parts of one size the more probable.  Otherwise a large error alone, settled, would be compared with
    itself and a useless one on the tangent.
    """
    for size in range(len(key), 0, -1):
        if parts := bent.keys() & set(combinations(key, size)):
            return next(value for part, value in bent.items() if part in parts)
    return 0.0


def _wandering(
    at: Frame, families: Sequence[Family], index: int, noise: NoiseLevel, reference: Reference
) -> tuple[Candidate, Settled]:
    """One error with a random step at every reading, its size averaged."""
    choices = [Choice(index, 0, node) for node in range(len(families[index].sizes))]
    tried = [settle(at, families, (choice,), noise, reference) for choice in choices]
    evidence = np.array([s.log_evidence for s in tried])
    mean = float(logsumexp(evidence) - np.log(len(tried)))
    best = int(evidence.argmax())
    share = np.log(BY_COUNT[1] * families[index].weight / sum(f.weight for f in families))
    return Candidate((choices[best],), mean, float(share)), tried[best]


def settle_base(bank: Bank) -> float:
    """Absolute log evidence of the base model by the frame's tangent."""
    D = np.linalg.svd(bank.frame.jacobian * bank.frame.prior_sd, compute_uv=False)
    return bank.base - 0.5 * float(np.sum(np.log1p(D**2)))
