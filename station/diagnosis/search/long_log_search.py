"""From residual to cause in a log of thousands of rows: as `trace`, with gross readings excluded in between.

Thousands of rows distinguish effects that a few leave undecided, and support curves of a hundred amplitudes;
a gross reading has little influence on either, but much on an effect of few readings. Readings are therefore
excluded as soon as no effect helps, and every finding is checked again beside all others.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import partial

import numpy as np
from scipy.special import fdtrc

from station.diagnosis.search import long_log
from station.diagnosis.search.cause_search import (
    SIGNIFICANT,
    WORTH,
    Finding,
    Stage,
    Trace,
    next_effect,
    odd_readings,
    significant,
)
from station.diagnosis.tests_of_fit import judge
from station.effects import Effect
from station.fitting import NotConvergedError, Outlier, Prior, solved
from station.model import Fit, Model, fit
from station.records import Flags, Real

EFFECTS_A_JOINT = 2
"""Maximum number, however much excluded readings support more."""
OUTLIER_ROUNDS = 4
WORST = 0.5
"""Readings that are off by less than this share of the worst one are checked again without it."""
ROUNDS = 4


def long_trace(base: Model, prior: Prior, specified_sd: Real, effects: Sequence[Effect]) -> Trace:
    """Fit, scan and add until nothing helps; exclude gross readings, drop the effects they suggested, repeat.

    :raises NotConvergedError: the base model does not converge.
    """
    fits = [fit(base, prior, specified_sd)]
    findings: list[Finding] = []
    left_out: tuple[Outlier, ...] = ()
    effects = list(effects)
    for _ in range(ROUNDS):
        _grow(fits, findings, prior, effects)
        off = _take_out(fits, prior)
        left_out = (*left_out, *off)
        dropped = _drop(fits, findings, prior, len(effects))
        # otherwise found and dropped forever
        effects = [e for e in effects if e not in dropped]
        if not off and not dropped:
            break
    stages = tuple(Stage(found, judge(found, found.model.mechanism.row_sd)) for found in fits)
    return Trace(stages, tuple(findings), (), left_out)


def _grow(fits: list[Fit], findings: list[Finding], prior: Prior, effects: Sequence[Effect]) -> None:
    refitted = partial(long_log.with_candidate, prior=prior)
    mechanism = fits[0].model.mechanism
    most = EFFECTS_A_JOINT * mechanism.measurements.joints
    while not judge(fits[-1], mechanism.row_sd).settled and len(findings) < most:
        chosen = next_effect(fits[-1], refitted, effects, SIGNIFICANT, hopeful=0.0)
        if chosen is None:
            return
        findings.append(chosen[0])
        fits.append(chosen[1])


def _take_out(fits: list[Fit], prior: Prior) -> tuple[Outlier, ...]:
    """Exclude the readings that are off the last model from every fit, in place.

    The worst go first: their influence on noise and curves made others look worse than they are.
    """
    off: tuple[Outlier, ...] = ()
    for _ in range(OUTLIER_ROUNDS):
        odd = odd_readings(fits[-1])
        if not odd:
            break
        worst = max(o.times_sd for o in odd)
        now = tuple(o for o in odd if o.times_sd > WORST * worst)
        off = (*off, *now)
        fits[-1] = long_log.without(fits[-1], _kept(fits[-1], now))
        _settle(fits, prior)
    if off:
        fits[:-1] = [long_log.without(found, _kept(found, off)) for found in fits[:-1]]
    return off


def _kept(found: Fit, off: tuple[Outlier, ...]) -> Flags:
    """(K,) readings that are none of these."""
    named = {o.reading for o in off}
    return np.array([i not in named for i in found.model.mechanism.measurements.ids])


def _settle(fits: list[Fit], prior: Prior) -> None:
    """Noise, spreads and unknowns of the last model again; by the linear step if that fails."""
    with suppress(NotConvergedError):
        fits[-1] = long_log.settled(fits[-1], prior)


def _drop(fits: list[Fit], findings: list[Finding], prior: Prior, tests: int) -> list[Effect]:
    """Remove effects that the last fit does not need from every fit, the least needed first, in place."""
    dropped = []
    while findings:
        last = fits[-1]
        needed = [_needed(last, k) for k in range(len(findings))]
        k = int(np.argmin([increase for increase, _ in needed]))
        increase, p_value = needed[k]
        if significant(p_value, tests, SIGNIFICANT) and increase >= WORTH * last.cost:
            break
        del last
        dropped.append(findings.pop(k).term.effect)
        fits[k + 1 :] = [long_log.less(found, k, prior) for found in fits[k + 2 :]]
        _settle(fits, prior)
    return dropped


def _needed(found: Fit, k: int) -> tuple[float, float]:
    """The increase of the cost without term k, and the p-value of its F test."""
    a, C = found.amplitudes(k)
    spread = found.model.terms[k].spread
    freedom = float(len(a)) if spread is None else max(float(np.sum(1.0 - np.diag(C) / spread**2)), 1.0)
    increase = float(a @ solved(C, a))
    dof = found.dof - freedom
    return increase, float(fdtrc(freedom, dof, (increase / freedom) / (found.cost / dof)))
