"""From residual to cause: add the effect that explains most, fit everything again, until it fits.

Winner and look-alikes are told apart by refitting the full nonlinear model with each of them: an
alias is whatever explains the readings as well, no more and no less (docs/decisions/0005).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from station import outliers
from station.diagnosis import long_log
from station.diagnosis.adequacy import ALPHA, Adequacy, judge
from station.diagnosis.departures import by_searched, turned
from station.diagnosis.model import Fit, Model, Term, fit, is_long
from station.diagnosis.scan import Candidate, Scan
from station.effects import Effect, doubtful
from station.kinematics import Real
from station.least_squares import NotConvergedError, Prior
from station.measurements import Measurements
from station.outliers import Outlier

MOST_EFFECTS = 3
READINGS_AN_EFFECT = 200
"""A long log may show more than three: one for so many readings,"""
EFFECTS_A_JOINT = 2
"""but no more than these."""
WORTH = 0.03
"""Of the rest's square, what an effect must take to be worth a place in the model."""
SIGNIFICANT = 0.01
"""Family-wise over the catalogue (Holm: the smallest p is held against the whole count)."""
RIVALS = 40.0
"""A candidate this much worse (chi-square) in the linear scan is not worth a nonlinear fit."""
HOPEFUL = 0.02
"""Unless it takes all but this share: a large effect is not quite linear."""
MOST_RIVALS = 6
MOST_POLISHING = 8
ODD_SHARE = 0.03
OUTLIER_ROUNDS = 4
END_SHARE = 0.12
"""Of the walk, in which readings off to one side together look like a step and not like slips of the head."""
ALIAS = 11.0
"""Chi-square by which a look-alike may be worse and still be the cause (true cause kept in 99.9 %)."""


@dataclass(frozen=True)
class Finding:
    """One effect added, and what could not be told apart from it."""

    term: Term
    p_value: float
    aliases: tuple[Term, ...]
    """Without the winner, best first."""


@dataclass(frozen=True)
class Stage:
    """One model on the way, with its fit and judgement."""

    fit: Fit
    adequacy: Adequacy


@dataclass(frozen=True)
class Trace:
    """The way from the base model to the last one."""

    stages: tuple[Stage, ...]
    """Base first, then one per effect added."""
    findings: tuple[Finding, ...]
    outliers: tuple[Outlier, ...]
    """Few single readings off the last model: the trace ends there, to be begun again without them."""
    left_out: tuple[Outlier, ...] = ()
    """Of a long log: readings that were off the last model and are in no fit any more."""

    @property
    def adequate(self) -> bool:
        return self.stages[-1].adequacy.passed


def trace(base: Model, prior: Prior, specified_sd: Real, effects: Sequence[Effect]) -> Trace:
    """Fit, judge, scan, add, again.

    :raises NotConvergedError: the base model does not converge.
    """
    stage = _settled(base, prior, specified_sd, None)
    stages = [stage]
    findings: list[Finding] = []
    long = is_long(stage.fit)
    odd = () if long else _odd_readings(stage.fit)
    most = _most_effects(base.mechanism.measurements)
    while not odd and not stage.adequacy.settled and len(findings) < most:
        scan = Scan(stage.fit)
        candidates = scan.candidates(_others(effects, stage.fit.model.terms))
        # where only the repeats are worse than specified, a cause must be plainer
        level = ALPHA if stage.adequacy.passed else SIGNIFICANT
        if not _significant(candidates, len(effects), level):
            break
        if candidates[0].reduction < WORTH * stage.fit.cost:
            break
        chosen = _add(scan, prior, candidates)
        if chosen is None:
            break
        finding, better = chosen
        findings.append(finding)
        stage = _settled(better.model, prior, specified_sd, better)
        stages.append(stage)
        if len(findings) > 1 and not long:
            findings = _reconsidered(findings, stage.fit, prior, effects)
            stages = _staged(base, findings, prior, specified_sd, stages[0])
            stage = stages[-1]
        # few gross readings of thousands mislead no scan, and to begin again would take long
        odd = () if long else _odd_readings(stage.fit)
    left_out = _take_out(stages, prior) if long else ()
    return Trace(tuple(stages), tuple(findings), odd, left_out)


def _take_out(stages: list[Stage], prior: Prior) -> tuple[Outlier, ...]:
    """Take the readings that are off a long log's last model out of every fit, one by one in place.

    The effects are known by then: the fits are changed as linear ones, and only the last one is fitted anew.
    """
    last = stages[-1].fit
    ids = last.model.mechanism.measurements.ids
    off: tuple[Outlier, ...] = ()
    for _ in range(OUTLIER_ROUNDS):
        more = _odd_readings(last)
        if not more:
            break
        off = (*off, *more)
        named = {o.reading for o in off}
        last = long_log.without(stages[-1].fit, np.array([i not in named for i in ids]))
    if not off:
        return ()
    kept = np.array([i not in named for i in ids])
    del last
    for k, stage in enumerate(stages):
        found = long_log.without(stage.fit, kept)
        if k == len(stages) - 1:
            found = fit(found.model, prior, found.row_sd, found.x)
        stages[k] = Stage(found, judge(found, found.model.mechanism.row_sd))
    return off


def _most_effects(m: Measurements) -> int:
    return max(MOST_EFFECTS, min(EFFECTS_A_JOINT * m.joints, len(m) // READINGS_AN_EFFECT))


def _reconsidered(
    findings: list[Finding], full: Fit, prior: Prior, effects: Sequence[Effect]
) -> list[Finding]:
    """Each earlier finding once more, beside all the others: it was chosen while they disturbed it."""
    best = full
    findings = list(findings)
    for k in range(len(findings) - 1):
        others = tuple(f.term for j, f in enumerate(findings) if j != k)
        try:
            without = fit(replace(full.model, terms=others), prior, full.row_sd)
        except NotConvergedError:
            continue
        scan = Scan(without)
        chosen = _add(scan, prior, scan.candidates(_others(effects, others)))
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
    """The model with its searched parameters where one linear step puts them."""
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
    """The way anew: the base model, then one more of the findings each."""
    terms = [f.term for f in findings]
    models = [replace(base, terms=tuple(terms[: k + 1])) for k in range(len(terms))]
    return [first, *(_settled(model, prior, specified_sd, None) for model in models)]


def with_alias(found: Trace, at: int, alias: Term, prior: Prior, specified_sd: Real) -> Trace:
    """The same way with a look-alike in the place of finding number `at`."""
    old = found.findings[at]
    others = (old.term, *(t for t in old.aliases if t is not alias))
    findings = list(found.findings)
    findings[at] = Finding(alias, old.p_value, others)
    first = found.stages[0]
    stages = _staged(first.fit.model, findings, prior, specified_sd, first)
    return replace(found, stages=tuple(stages), findings=tuple(findings))


def _odd_readings(found: Fit) -> tuple[Outlier, ...]:
    """Single readings off the model: first those of which an effect in it can say nothing.

    Many others, or a few together at an end, are an effect.
    """
    measurements = found.model.mechanism.measurements
    odd = outliers.off(found.model.mechanism, found.solution, found.row_sd)
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


def _significant(candidates: list[Candidate], tests: int, level: float) -> bool:
    return bool(candidates) and candidates[0].p_value * tests < level


def _settled(model: Model, prior: Prior, specified_sd: Real, better: Fit | None) -> Stage:
    """Fit with the noise that the repeats of this very model show, if they are better than specified."""
    found = fit(model, prior, specified_sd) if better is None else better
    if is_long(found):
        return Stage(found, judge(found, specified_sd))
    for _ in range(2):
        adequacy = judge(found, specified_sd)
        sd = found.row_sd * adequacy.pure_factor
        if np.isnan(adequacy.pure_factor) or (sd > specified_sd).any():
            sd = specified_sd
        if np.allclose(sd, found.row_sd, rtol=0.02):
            break
        found = fit(model, prior, sd)
    return Stage(found, judge(found, specified_sd))


def _add(scan: Scan, prior: Prior, candidates: list[Candidate]) -> tuple[Finding, Fit] | None:
    """Refit with the best candidates, keep the best, name those that do as well."""
    current = scan.fit
    refined = [scan.refine(c) for c in candidates[: 2 * MOST_RIVALS] if c.visible]
    if not refined:
        return None
    best = max(refined, key=lambda c: c.reduction)
    unit = _noise_square(current.cost - best.reduction, current.dof - best.size)
    long = is_long(current)
    worst = max(current.cost - best.reduction + RIVALS * unit, 0.0 if long else HOPEFUL * current.cost)
    rivals = [c for c in refined if current.cost - c.reduction < worst]
    fits: list[tuple[float, Candidate, Fit]] = []
    for c in sorted(rivals, key=lambda c: -c.reduction)[:MOST_RIVALS]:
        try:
            if long:
                refit = long_log.with_candidate(scan, c, prior)
            else:
                model = replace(current.model, terms=(*current.model.terms, c.term()))
                # not from the current fit: without the effect the base parameters may have gone far astray
                refit = fit(model, prior, current.row_sd)
        except NotConvergedError:
            continue
        fits.append((_score(refit, c), c, refit))
    if not fits:
        return None
    fits.sort(key=lambda item: item[0])
    _, winner, better = fits[0]
    unit = _noise_square(better.cost, better.dof - winner.size)
    aliases: dict[tuple[str, int | None], Term] = {}
    for _, c, refit in fits[1:]:
        if (refit.cost - better.cost) / unit < ALIAS + 2.0 * (winner.freedom - c.freedom):
            aliases.setdefault(c.term().key, c.term())
    aliases.pop(winner.term().key, None)
    return Finding(winner.term(), winner.p_value, tuple(aliases.values())), better


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
