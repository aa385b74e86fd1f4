"""From residual to cause: add the effect that explains most, fit everything again, until it fits.

Winner and aliases are distinguished by refitting the full nonlinear model with each of them: an alias
explains the readings as well as the winner (docs/decisions/0005).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from station.diagnosis.search.scan import Candidate, Scan
from station.diagnosis.tests_of_fit import ALPHA, Adequacy, by_searched, judge, left_out_rms, turned
from station.effects import Effect, doubtful
from station.fitting import NotConvergedError, Outlier, Prior, outliers_of_fit
from station.model import Fit, Model, Term, fit
from station.records import Real

MOST_EFFECTS = 3
WORTH = 0.03
"""Share of the residual's sum of squares that an effect must take to be added to the model."""
SIGNIFICANT = 0.01
"""Family-wise over the catalogue (Holm: the smallest p is held against the whole count)."""
ALTERNATIVES = 40.0
"""A candidate that is this much worse (chi-square) in the linear scan is not fitted nonlinearly."""
HOPEFUL = 0.02
"""Unless it leaves only this share: a large effect is not quite linear."""
MOST_ALTERNATIVES = 6
MOST_POLISHING = 8
MOST_STEPS = 40
"""Steps of a fit with a candidate: one that needs more does not suit the readings."""
TRIED_TOGETHER = 2 * MOST_ALTERNATIVES
"""Number of candidates compared for an effect to be added; if none helps, the same number after them."""
HELPFUL = 0.995
"""Error of excluded readings over that without the effect: below this they support it."""
PLAINLY_HELPFUL = 0.97
"""The same for candidates after the best ones: more candidates help by chance."""
ODD_SHARE = 0.03
END_SHARE = 0.12
"""Share of the sequence in which readings that deviate to one side indicate a step, not slips."""
ALIAS = 11.0
"""Chi-square by which an alias may be worse and still be the cause (the true cause is included in 99.9 %)."""


Refitted = Callable[[Scan, Candidate], Fit]
"""The scanned fit with a candidate added."""


@dataclass(frozen=True)
class Finding:
    """One effect added, and those that cannot be distinguished from it."""

    term: Term
    p_value: float
    aliases: tuple[Term, ...]
    """Without the winner, best first."""


@dataclass(frozen=True)
class Stage:
    """One model in the sequence, with its fit and judgement."""

    fit: Fit
    adequacy: Adequacy


@dataclass(frozen=True)
class Trace:
    """The sequence from the base model to the last one."""

    stages: tuple[Stage, ...]
    """Base first, then one stage per effect added."""
    findings: tuple[Finding, ...]
    outliers: tuple[Outlier, ...]
    """A few single readings off the last model: the trace ends there, and begins again without them."""
    left_out: tuple[Outlier, ...] = ()
    """In a long log: readings off the model, which are excluded from all fits."""

    @property
    def adequate(self) -> bool:
        return self.stages[-1].adequacy.passed


def trace(base: Model, prior: Prior, specified_sd: Real, effects: Sequence[Effect]) -> Trace:
    """Fit, judge, scan, add, again.

    :raises NotConvergedError: the base model does not converge.
    """
    refitted = partial(_with_candidate, prior=prior)
    stages = [_settled(base, prior, specified_sd, None)]
    findings: list[Finding] = []
    odd = odd_readings(stages[0].fit)
    while not odd and not stages[-1].adequacy.settled and len(findings) < MOST_EFFECTS:
        # where only the repeats are worse than specified, a cause must be clearer
        level = ALPHA if stages[-1].adequacy.passed else SIGNIFICANT
        chosen = next_effect(stages[-1].fit, refitted, effects, level, HOPEFUL)
        if chosen is None:
            break
        finding, better = chosen
        findings.append(finding)
        stages.append(_settled(better.model, prior, specified_sd, better))
        if len(findings) > 1:
            findings = _reconsidered(findings, stages[-1].fit, prior, effects)
            stages = _staged(base, findings, prior, specified_sd, stages[0])
        odd = odd_readings(stages[-1].fit)
    return Trace(tuple(stages), tuple(findings), odd)


def next_effect(
    found: Fit, refitted: Refitted, effects: Sequence[Effect], level: float, hopeful: float
) -> tuple[Finding, Fit] | None:
    """The effect that explains most of a fit's residual, and the fit with it; None if it is not worth adding.

    effects: the catalogue; level: of the test over all of it; hopeful: see `HOPEFUL`.
    """
    scan = Scan(found)
    candidates = scan.candidates(_others(effects, found.model.terms))

    def worthy(candidate: Candidate) -> bool:
        return (
            significant(candidate.p_value, len(effects), level) and candidate.reduction >= WORTH * found.cost
        )

    if not candidates or not worthy(candidates[0]):
        return None
    if (added := _add(scan, refitted, candidates[:TRIED_TOGETHER], hopeful)) is not None:
        return added
    # the best may be narrow waves that excluded readings do not support, and a curve behind them real
    behind = [c for c in candidates[TRIED_TOGETHER:] if worthy(c)][:TRIED_TOGETHER]
    return _add(scan, refitted, behind, hopeful, PLAINLY_HELPFUL)


def _possible(found: Fit) -> bool:
    """Whether physics allows the size of the effect added last."""
    k = len(found.model.terms) - 1
    term = found.model.terms[k]
    return term.effect.possible(term.hidden, *found.amplitudes(k))


def significant(p_value: float, tests: int, level: float) -> bool:
    """Whether the smallest of this many p-values is significant, family-wise (Holm)."""
    return p_value * tests < level


def _with_candidate(scan: Scan, candidate: Candidate, prior: Prior) -> Fit:
    current = scan.fit
    model = replace(current.model, terms=(*current.model.terms, candidate.term()))
    # not from the current fit: without the effect the base parameters may be far off
    return fit(model, prior, current.row_sd, most_steps=MOST_STEPS)


def _reconsidered(
    findings: list[Finding], full: Fit, prior: Prior, effects: Sequence[Effect]
) -> list[Finding]:
    """Each earlier finding chosen again, beside all the others: they disturbed the first choice."""
    refitted = partial(_with_candidate, prior=prior)
    best = full
    findings = list(findings)
    for k in range(len(findings) - 1):
        others = tuple(f.term for j, f in enumerate(findings) if j != k)
        try:
            without = fit(replace(full.model, terms=others), prior, full.row_sd)
        except NotConvergedError:
            continue
        scan = Scan(without)
        chosen = _add(scan, refitted, scan.candidates(_others(effects, others)), HOPEFUL)
        if chosen is not None and chosen[1].cost <= best.cost:
            findings[k], best = chosen
    return _polished(findings, best, prior)


def _polished(findings: list[Finding], found: Fit, prior: Prior) -> list[Finding]:
    """All searched parameters together (Gauss-Newton): two close periods shift one another.

    found: fit with the terms of the findings, in any order.
    """
    model = replace(found.model, terms=tuple(f.term for f in findings))
    try:
        best = fit(model, prior, found.row_sd)
        for _ in range(MOST_POLISHING):
            better = fit(_stepped(best), prior, found.row_sd)
            if better.cost > best.cost - 1.0:
                break
            best = better
    except NotConvergedError:
        return findings
    return [replace(f, term=term) for f, term in zip(findings, best.model.terms, strict=True)]


def _stepped(found: Fit) -> Model:
    """The model with its searched parameters after one linear step."""
    searched = list(by_searched(found.model, found.x, found.conditions))
    if not searched:
        return found.model
    own = np.column_stack([column for *_, column in searched]) / found.row_sd[:, None]
    step = Scan(found).step(own)
    model = found.model
    for (k, name, _), by in zip(searched, step, strict=True):
        term = model.terms[k]
        low, high = term.effect.refined(term.hidden, found.conditions)[name]
        model = turned(model, k, name, float(np.clip(by, low - term.hidden[name], high - term.hidden[name])))
    return model


def _staged(
    base: Model, findings: list[Finding], prior: Prior, specified_sd: Real, first: Stage
) -> list[Stage]:
    """The sequence again: the base model, then one more of the findings each."""
    terms = [f.term for f in findings]
    models = [replace(base, terms=tuple(terms[: k + 1])) for k in range(len(terms))]
    return [first, *(_settled(model, prior, specified_sd, None) for model in models)]


def with_alias(found: Trace, at: int, alias: Term, prior: Prior, specified_sd: Real) -> Trace:
    """The same sequence with an alias in place of finding number `at`."""
    old = found.findings[at]
    others = (old.term, *(t for t in old.aliases if t is not alias))
    findings = list(found.findings)
    findings[at] = Finding(alias, old.p_value, others)
    first = found.stages[0]
    stages = _staged(first.fit.model, findings, prior, specified_sd, first)
    return replace(found, stages=tuple(stages), findings=tuple(findings))


def odd_readings(found: Fit) -> tuple[Outlier, ...]:
    """Single readings off the model: first those for which an effect in it cannot make a prediction.

    If there are many, or a few together at an end, they are an effect.
    """
    measurements = found.model.mechanism.measurements
    odd = outliers_of_fit(found.model.mechanism, found.solution, found.row_sd)
    n = len(measurements)
    in_doubt = doubtful((term.effect for term in found.model.terms), found.conditions)
    doubted = {measurements.ids[k] for k in np.flatnonzero(in_doubt)}
    if any(o.reading in doubted for o in odd):
        return tuple(o for o in odd if o.reading in doubted)
    if len(odd) > max(1, int(ODD_SHARE * n)):
        return ()
    if len(odd) > 1 and len({o.residual_mm > 0 for o in odd}) == 1:
        named = {o.reading for o in odd}
        rank = np.argsort(np.argsort(measurements.t_s, kind="stable"))
        at = rank[[i in named for i in measurements.ids]]
        if at.max() < END_SHARE * n or at.min() >= (1.0 - END_SHARE) * n:
            return ()
    return odd


def _settled(model: Model, prior: Prior, specified_sd: Real, better: Fit | None) -> Stage:
    """Fit with the noise that the repeats of this model show, if they are better than specified."""
    found = fit(model, prior, specified_sd) if better is None else better
    for _ in range(2):
        adequacy = judge(found, specified_sd)
        sd = found.row_sd * adequacy.pure_factor
        if np.isnan(adequacy.pure_factor) or (sd > specified_sd).any():
            sd = specified_sd
        if np.allclose(sd, found.row_sd, rtol=0.02):
            break
        found = fit(model, prior, sd)
    return Stage(found, judge(found, specified_sd))


def _add(
    scan: Scan, refitted: Refitted, candidates: list[Candidate], hopeful: float, helpful: float = HELPFUL
) -> tuple[Finding, Fit] | None:
    """Refit with the best candidates, select the best, and list those that are as good."""
    current = scan.fit
    refined = [scan.refine(c) for c in candidates[:TRIED_TOGETHER] if c.visible]
    if not refined:
        return None
    best = max(refined, key=lambda c: c.reduction)
    unit = _noise_square(current.cost - best.reduction, current.dof - best.size)
    worst = max(current.cost - best.reduction + ALTERNATIVES * unit, hopeful * current.cost)
    alternatives = [c for c in refined if current.cost - c.reduction < worst]
    # readings that a fit has not used must be predicted better, block by block
    most_mm = helpful * left_out_rms(current)
    refits: list[_Refit] = []
    for c in sorted(alternatives, key=lambda c: -c.reduction)[:MOST_ALTERNATIVES]:
        try:
            refit = refitted(scan, c)
        except NotConvergedError:
            continue
        if _possible(refit) and (left_out_mm := left_out_rms(refit)) < most_mm:
            refits.append(_Refit(c, refit, _score(refit, c), left_out_mm))
    if not refits:
        return None
    best_refit = _common(min(refits, key=lambda r: r.score), refits)
    winner, better = best_refit.candidate, best_refit.fit
    unit = _noise_square(better.cost, better.dof - winner.size)
    aliases: dict[tuple[str, int | None], Term] = {}
    # where the model does not fit yet, a cost says too much: of one joint, left-out readings decide as well
    for one in sorted(refits, key=lambda r: r.score):
        c = one.candidate
        as_good = (one.fit.cost - better.cost) / unit < ALIAS + 2.0 * (winner.freedom - c.freedom)
        if as_good or one.predicts_as_well_as(best_refit):
            aliases.setdefault(c.term().key, c.term())
    aliases.pop(winner.term().key, None)
    return Finding(winner.term(), winner.p_value, tuple(aliases.values())), better


@dataclass(frozen=True)
class _Refit:
    """The fit with a candidate."""

    candidate: Candidate
    fit: Fit
    score: float
    left_out_mm: float
    """Root mean square of the errors at readings that the fit has not used."""

    def predicts_as_well_as(self, other: _Refit) -> bool:
        """Whether it has an effect of the same joint and predicts left-out readings as well."""
        same_joint = self.candidate.effect.joint == other.candidate.effect.joint
        return same_joint and self.left_out_mm < other.left_out_mm / HELPFUL


def _common(best: _Refit, refits: Sequence[_Refit]) -> _Refit:
    """The best refit; one with a rare effect gives way to a common effect that predicts as well."""
    if not best.candidate.effect.rare:
        return best
    as_good = [r for r in refits if not r.candidate.effect.rare and r.predicts_as_well_as(best)]
    return min(as_good, key=lambda r: r.score, default=best)


def _noise_square(cost: float, dof: int) -> float:
    return max(cost, 1e-12) / max(dof, 1)


def _score(refit: Fit, c: Candidate) -> float:
    """Minus twice the log likelihood with unknown noise, plus the price of freedom and of the search."""
    n = len(refit.row_sd)
    return (
        n * float(np.log(max(refit.cost, 1e-12))) + 2.0 * c.freedom + 2.0 * float(np.log(c.variants.trials))
    )


def _others(effects: Sequence[Effect], terms: tuple[Term, ...]) -> list[Effect]:
    """Effects not in the model yet, and those that may be in it twice."""
    present = {term.effect for term in terms}
    covered = {(name, term.effect.joint) for term in terms for name in term.effect.covers}
    free = [e for e in effects if (e.id, e.joint) not in covered]
    return [e for e in free if e.repeats or e not in present]
