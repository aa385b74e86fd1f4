"""The closed loop on one set of readings, with or without fresh ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from station.diagnosis.decision import GOOD_SHARE, Decision, StageFigures, decide
from station.diagnosis.search import Hint, Stage, Trace, hints, long_trace, trace, with_alias
from station.diagnosis.tests_of_fit import FEWEST, Confirmation, Rest, confirm, of_fit, rest_of, strongest
from station.effects import Effect
from station.errors import InputRefused
from station.fitting import FEWEST_REPEATS, NotConvergedError, Outlier, tolerance_prior
from station.five_bar import check_places
from station.machines import AnyMechanism, AnyRobot, effects_of, mechanism_of
from station.mechanism import Mechanism, reference_of
from station.model import Fit, Model, is_long
from station.records import DiagnosisVerdict, Measurements

FEWEST_READINGS = 30
"""Thirteen unknowns and an effect leave too little of fewer readings to judge a residual by."""
FEWEST_NOISE_DOF = 10
MOST_LEFT_OUT = 0.05
USELESS = 0.6
"""Fresh residual over that of the base model from which on an added effect predicts nothing worth having."""


@dataclass(frozen=True)
class Diagnosis:
    """What became of one residual."""

    robot: AnyRobot
    measurements: Measurements
    """The readings that took part."""
    outliers: tuple[Outlier, ...]
    trace: Trace
    fresh: Measurements | None
    confirmations: tuple[Confirmation, ...]
    """One per stage; empty without fresh readings."""
    hints: tuple[Hint, ...]
    rival: str | None
    """A nameless dependence that makes the readings about as probable as the effects found."""

    @property
    def base(self) -> Fit:
        return self.trace.stages[0].fit

    @property
    def last(self) -> Fit:
        return self.trace.stages[-1].fit

    @property
    def explained_share(self) -> float:
        """Of the base residual's square beyond the noise."""
        before = np.sum(self.base.residual_mm**2)
        after = np.sum(self.last.residual_mm**2)
        return float(1.0 - after / before)

    @cached_property
    def decision(self) -> Decision:
        """Verdict and trusted stage."""
        checks = self.confirmations or (None,) * len(self.trace.stages)
        figures = [_figures(stage, check) for stage, check in zip(self.trace.stages, checks, strict=True)]
        return decide(figures, alternative=self.rival is not None, share=self.explained_share)

    @property
    def verdict(self) -> DiagnosisVerdict:
        return self.decision.verdict

    @property
    def confirmed(self) -> bool | None:
        """Whether the last model predicted fresh readings; None without any."""
        return self.decision.confirmed


def _figures(stage: Stage, check: Confirmation | None) -> StageFigures:
    fit_ratio = stage.fit.cost / max(stage.fit.dof, 1)
    if check is None:
        return StageFigures(stage.adequacy.passed, fit_ratio)
    fresh_ratio = float(np.mean((check.residual_mm / check.sd_mm) ** 2))
    return StageFigures(stage.adequacy.passed, fit_ratio, check.confirmed, check.rms_mm, fresh_ratio)


def diagnose(
    robot: AnyRobot,
    measurements: Measurements,
    fresh: Measurements | None = None,
    effects: Sequence[Effect] | None = None,
) -> Diagnosis:
    """Residual, cause, model, confirmation.

    :raises InputRefused: the readings are malformed or not enough to judge, with what is missing.
    """
    mechanism = mechanism_of(robot, measurements)
    mechanism.check()
    check_places(measurements)
    check_enough(mechanism)
    if fresh is not None:
        mechanism.of(fresh).check()
        if len(fresh) < FEWEST:
            raise InputRefused(f"Only {len(fresh)} fresh readings; at least {FEWEST} are needed to confirm.")
        fresh = _on_same_mounts(fresh, measurements)
    effects = effects_of(mechanism) if effects is None else effects
    kept = measurements
    found = _trace(mechanism, effects)
    left_out = found.left_out
    while found.outliers and len(left_out) < MOST_LEFT_OUT * len(measurements):
        left_out = (*left_out, *found.outliers)
        named = {o.reading for o in found.outliers}
        kept = kept.take(np.array([i not in named for i in kept.ids]))
        found = _trace(mechanism.of(kept), effects)
    checks: tuple[Confirmation, ...] = ()
    if fresh is not None:
        found, checks = _confirmed(found, fresh)
    rival = _rival(found, checks)
    unexplained = not found.adequate or rival is not None or (bool(checks) and not checks[-1].confirmed)
    described = 0 if rival is not None or _hopeless(found, checks) else -1
    return Diagnosis(
        robot=robot,
        measurements=found.stages[-1].fit.model.mechanism.measurements,
        outliers=left_out,
        trace=found,
        fresh=fresh,
        confirmations=checks,
        hints=hints(_rest(found, checks, described)) if unexplained else (),
        rival=rival,
    )


def _confirmed(found: Trace, fresh: Measurements) -> tuple[Trace, tuple[Confirmation, ...]]:
    """Every stage against the fresh readings; they also settle between look-alikes left open by the walk."""
    base = found.stages[0].fit
    mechanism = base.model.mechanism
    checks = tuple(_check(base, stage, fresh) for stage in found.stages)
    if not found.findings or not found.adequate or checks[-1].confirmed or is_long(mechanism):
        return found, checks
    for at, finding in enumerate(found.findings):
        for alias in finding.aliases:
            try:
                other = with_alias(found, at, alias, tolerance_prior(mechanism), mechanism.row_sd)
            except NotConvergedError:
                continue
            check = _check(base, other.stages[-1], fresh)
            if other.adequate and check.confirmed:
                return other, (*(_check(base, stage, fresh) for stage in other.stages[:-1]), check)
    return found, checks


def _check(base: Fit, stage: Stage, fresh: Measurements) -> Confirmation:
    return confirm(base, stage.fit, fresh, max(stage.adequacy.pure_dof, FEWEST_NOISE_DOF))


def check_enough(mechanism: Mechanism) -> None:
    """:raises InputRefused: "not enough data to judge", with what is missing."""
    measurements, unknowns = mechanism.measurements, len(mechanism.parameters)
    groups = measurements.repeat_group
    repeats = len(groups) - len(np.unique(groups))
    fewest = max(FEWEST_READINGS, 2 * unknowns)
    missing = []
    if len(measurements) < fewest:
        missing.append(f"{fewest - len(measurements)} more readings")
    if mechanism.needs_repeats and repeats < FEWEST_REPEATS:
        missing.append(
            f"{FEWEST_REPEATS - repeats} more repeats (readings that share `position` and approach)"
        )
    if missing:
        raise InputRefused(f"Not enough data to judge: {' and '.join(missing)} are needed.")


def _on_same_mounts(fresh: Measurements, learned: Measurements) -> Measurements:
    """Fresh readings with their mounts numbered as in the readings learned on.

    :raises InputRefused: a mount whose offset was not learned.
    """
    unknown = [name for name in fresh.mounts if name not in learned.mounts]
    if unknown:
        raise InputRefused(f"The fresh readings are of mount {unknown[0]!r}, which the walk never used.")
    renumbered = np.array([learned.mounts.index(name) for name in fresh.mounts])
    return replace(fresh, mount=renumbered[fresh.mount], mounts=learned.mounts)


def _trace(mechanism: AnyMechanism, effects: Sequence[Effect]) -> Trace:
    traced = long_trace if is_long(mechanism) else trace
    try:
        return traced(
            Model(mechanism, reference_of(mechanism.measurements)),
            tolerance_prior(mechanism),
            mechanism.row_sd,
            effects,
        )
    except NotConvergedError as error:
        raise InputRefused(
            f"The identification did not converge ({error}); check that angles and distances belong together."
        ) from error


def _rival(found: Trace, checks: Sequence[Confirmation]) -> str | None:
    """Of the effects found, by all readings there are."""
    if checks:
        return checks[-1].rival
    base, last = found.stages[0].fit, found.stages[-1].fit
    if not found.findings or not found.adequate or is_long(last.model.mechanism):
        return None
    without = Rest((of_fit(base, last.row_sd),), base.prior, base.x)
    return strongest(without, _rest(found, checks, -1), last.model.terms, last.conditions)


def _rest(found: Trace, checks: Sequence[Confirmation], stage: int) -> Rest:
    """What a stage leaves, of fresh readings too where there are any."""
    if checks:
        return checks[stage].rest
    return rest_of(found.stages[stage].fit)


def _hopeless(found: Trace, checks: Sequence[Confirmation]) -> bool:
    """The effects found take or predict so little that the rest is better described from the base on."""
    if checks:
        return checks[-1].rms_mm > USELESS * checks[0].rms_mm
    before = float(np.sum(found.stages[0].fit.residual_mm ** 2))
    after = float(np.sum(found.stages[-1].fit.residual_mm ** 2))
    return not found.adequate and 1.0 - after / before < GOOD_SHARE
