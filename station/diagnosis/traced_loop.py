"""The search effect by effect on one set of readings, with or without fresh ones (method.md section 3).

It is used for arms; a five-bar is diagnosed with the set of its explanations (`weighed_loop`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from station.diagnosis.decision import GOOD_SHARE, Decision, StageFigures, decide
from station.diagnosis.readiness import check_enough, checked_fresh
from station.diagnosis.search import (
    Hint,
    Stage,
    Trace,
    gross_readings,
    hints,
    long_trace,
    trace,
    with_alias,
)
from station.diagnosis.tests_of_fit import (
    Confirmation,
    WhitenedResidual,
    confirm,
    left_out_rms,
    of_fit,
    strongest,
    whitened_residual,
)
from station.diagnosis.unnamed_error import UnnamedError, unnamed_error
from station.effects import Effect
from station.errors import InputRefused
from station.fitting import NotConvergedError, Outlier, tolerance_prior
from station.five_bar import check_places
from station.machines import AnyMechanism, AnyRobot, effects_of, mechanism_of
from station.mechanism import reference_of
from station.model import Fit, Model, is_long
from station.records import DiagnosisVerdict, Measurements

FEWEST_NOISE_DOF = 10
MOST_LEFT_OUT = 0.05
USELESS = 0.6
"""Fresh residual over that of the base model above which an added effect has no predictive value."""


@dataclass(frozen=True)
class TracedDiagnosis:
    """The result for one residual."""

    robot: AnyRobot
    measurements: Measurements
    """The readings that were used."""
    outliers: tuple[Outlier, ...]
    trace: Trace
    fresh: Measurements | None
    confirmations: tuple[Confirmation, ...]
    """One per stage; empty without fresh readings."""
    hints: tuple[Hint, ...]
    alternative: str | None
    """An unnamed dependence that makes the readings about as probable as the effects found."""

    unnamed: UnnamedError | None = None
    """A smooth error of the pose in the last model's residual, where excluded readings support it."""

    @property
    def base(self) -> Fit:
        return self.trace.stages[0].fit

    @property
    def last(self) -> Fit:
        return self.trace.stages[-1].fit

    @property
    def explained_share(self) -> float:
        """Share of the square of the base model's error at unused readings: fresh ones, otherwise blocks."""
        if self.confirmations:
            before, after = self.confirmations[0].rms_mm, self.confirmations[-1].rms_mm
        else:
            before, after = left_out_rms(self.base), left_out_rms(self.last)
        return float(1.0 - (after / before) ** 2) if before > 0.0 else 0.0

    @cached_property
    def decision(self) -> Decision:
        """Verdict and trusted stage."""
        checks = self.confirmations or (None,) * len(self.trace.stages)
        figures = [_figures(*stage, checks[0]) for stage in zip(self.trace.stages, checks, strict=True)]
        return decide(figures, alternative=self.alternative is not None, share=self.explained_share)

    @property
    def verdict(self) -> DiagnosisVerdict:
        return self.decision.verdict

    @property
    def confirmed(self) -> bool | None:
        """Whether the last model predicted fresh readings; None without any."""
        return self.decision.confirmed


def _figures(stage: Stage, check: Confirmation | None, base: Confirmation | None) -> StageFigures:
    fit_ratio = stage.fit.cost / max(stage.fit.dof, 1)
    adequate = stage.adequacy.passed and stage.fit.solution.complete
    if check is None or base is None:
        return StageFigures(adequate, fit_ratio)
    fresh_ratio = float(np.mean((check.residual_mm / check.sd_mm) ** 2))
    # effects that predict fresh readings worse than no effect are refuted, whatever their uncertainty
    confirmed = check.confirmed and check.rms_mm <= base.rms_mm
    return StageFigures(adequate, fit_ratio, confirmed, check.rms_mm, fresh_ratio)


def traced(
    robot: AnyRobot,
    measurements: Measurements,
    fresh: Measurements | None = None,
    effects: Sequence[Effect] | None = None,
) -> TracedDiagnosis:
    """Residual, cause, model, confirmation.

    :raises InputRefused: the readings are malformed or too few; the error states what is missing.
    """
    mechanism = mechanism_of(robot, measurements)
    mechanism.check()
    check_places(measurements)
    check_enough(mechanism)
    if fresh is not None:
        fresh = checked_fresh(mechanism, fresh)
    effects = effects_of(mechanism) if effects is None else effects
    gross = gross_readings(mechanism, tolerance_prior(mechanism))
    kept = _without(measurements, gross)
    found = _trace(mechanism.of(kept) if gross else mechanism, effects)
    left_out = (*gross, *found.left_out)
    while found.outliers and len(left_out) < MOST_LEFT_OUT * len(measurements):
        left_out = (*left_out, *found.outliers)
        kept = _without(kept, found.outliers)
        found = _trace(mechanism.of(kept), effects)
    checks: tuple[Confirmation, ...] = ()
    if fresh is not None:
        found, checks = _confirmed(found, fresh)
    alternative = _alternative(found, checks)
    unexplained = not found.adequate or alternative is not None or (bool(checks) and not checks[-1].confirmed)
    described = 0 if alternative is not None or _hopeless(found, checks) else -1
    return TracedDiagnosis(
        robot=robot,
        measurements=found.stages[-1].fit.model.mechanism.measurements,
        outliers=left_out,
        trace=found,
        fresh=fresh,
        confirmations=checks,
        hints=hints(_residual(found, checks, described)) if unexplained else (),
        alternative=alternative,
        unnamed=None if found.adequate else unnamed_error(found.stages[-1].fit),
    )


def _without(measurements: Measurements, off: Sequence[Outlier]) -> Measurements:
    named = {o.reading for o in off}
    return measurements.take(np.array([i not in named for i in measurements.ids]))


def _confirmed(found: Trace, fresh: Measurements) -> tuple[Trace, tuple[Confirmation, ...]]:
    """Every stage against the fresh readings; they also decide between undecided causes."""
    base = found.stages[0].fit
    mechanism = base.model.mechanism
    checks = tuple(_check(base, stage, fresh) for stage in found.stages)
    if not found.findings or not found.adequate or checks[-1].confirmed or is_long(mechanism):
        return _supported(found, checks)
    for at, finding in enumerate(found.findings):
        for alias in finding.aliases:
            try:
                other = with_alias(found, at, alias, tolerance_prior(mechanism), mechanism.row_sd)
            except NotConvergedError:
                continue
            check = _check(base, other.stages[-1], fresh)
            if other.adequate and check.confirmed:
                return other, (*(_check(base, stage, fresh) for stage in other.stages[:-1]), check)
    return _supported(found, checks)


def _supported(found: Trace, checks: tuple[Confirmation, ...]) -> tuple[Trace, tuple[Confirmation, ...]]:
    """Without the last effects, if the fresh readings are predicted no better with them."""
    count = len(checks)
    while count > 1 and checks[count - 1].rms_mm >= checks[count - 2].rms_mm:
        count -= 1
    return replace(found, stages=found.stages[:count], findings=found.findings[: count - 1]), checks[:count]


def _check(base: Fit, stage: Stage, fresh: Measurements) -> Confirmation:
    return confirm(base, stage.fit, fresh, max(stage.adequacy.pure_dof, FEWEST_NOISE_DOF))


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
            f"The identification cannot start: {error}; check the robot file and that angles and readings "
            "belong together."
        ) from error


def _alternative(found: Trace, checks: Sequence[Confirmation]) -> str | None:
    """An alternative to the effects found, from all readings."""
    if checks:
        return checks[-1].alternative
    base, last = found.stages[0].fit, found.stages[-1].fit
    if not found.findings or not found.adequate or is_long(last.model.mechanism):
        return None
    without = WhitenedResidual((of_fit(base, last.row_sd),), base.prior, base.x)
    return strongest(without, _residual(found, checks, -1), last.model.terms, last.conditions)


def _residual(found: Trace, checks: Sequence[Confirmation], stage: int) -> WhitenedResidual:
    """A stage's residual, including fresh readings where there are any."""
    if checks:
        return checks[stage].whitened
    return whitened_residual(found.stages[stage].fit)


def _hopeless(found: Trace, checks: Sequence[Confirmation]) -> bool:
    """Whether the effects take or predict so little that the base model describes the residual better."""
    if checks:
        return checks[-1].rms_mm > USELESS * checks[0].rms_mm
    before = float(np.sum(found.stages[0].fit.residual_mm ** 2))
    after = float(np.sum(found.stages[-1].fit.residual_mm ** 2))
    return not found.adequate and 1.0 - after / before < GOOD_SHARE
