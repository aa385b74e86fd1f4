"""All results of a search effect by effect, and its document (schema station.diagnosis/1)."""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np

from station.diagnosis.decision import Decision
from station.diagnosis.learned import model_document
from station.diagnosis.report.detectability import detectable
from station.diagnosis.report.findings import Findings, FoundEffect, ResidualView
from station.diagnosis.report.joint_curves import Curve, curves
from station.diagnosis.report.predicted_error import position_errors
from station.diagnosis.report.sentence import verdict_reason
from station.diagnosis.report.stages import stage_errors
from station.diagnosis.report.tracked import true_position_errors
from station.diagnosis.search import Hint
from station.diagnosis.traced_loop import TracedDiagnosis
from station.fitting import Noise
from station.machines import effects_of, kind_of
from station.mechanism import by_reading
from station.model import Fit, Term
from station.records import (
    LIMIT_SDS,
    EffectName,
    ModelDocument,
    PositionError,
    Quantity,
    Real,
    Reason,
    SmallestVisible,
    StageErrors,
    WeakDirection,
)


class TracedFindings(Findings):
    """Results of the last model of a search."""

    schema = "station.diagnosis/1"

    def __init__(self, diagnosis: TracedDiagnosis) -> None:
        self.diagnosis = diagnosis
        self.robot = diagnosis.robot
        self.measurements = diagnosis.measurements
        self.outliers = diagnosis.outliers
        self.fresh_outliers = diagnosis.confirmations[-1].left_out if diagnosis.confirmations else ()

    @property
    def hints(self) -> tuple[Hint, ...]:
        """The quantities that an unexplained residual depends on."""
        return self.diagnosis.hints

    @property
    def added(self) -> tuple[str, ...]:
        """Labels of the effects in the order of the search."""
        return tuple(finding.term.effect.label for finding in self.diagnosis.trace.findings)

    @cached_property
    def decision(self) -> Decision:
        """Verdict and trusted stage."""
        return self.diagnosis.decision

    @property
    def fit(self) -> Fit:
        """Fit of the trusted stage."""
        return self.diagnosis.trace.stages[self.decision.trusted].fit

    @cached_property
    def noise(self) -> Noise:
        """Noise of the last stage."""
        last = self.diagnosis.trace.stages[-1]
        specified = last.fit.model.mechanism.row_sd
        source: Literal["repeats", "specification"] = "repeats"
        if np.array_equal(last.fit.row_sd, specified):
            source = "specification"
        return Noise(last.fit.row_sd, source, last.adequacy.pure_dof if source == "repeats" else 0)

    @cached_property
    def parameters(self) -> tuple[Quantity, ...]:
        """Base parameters of the trusted fit in shown units."""
        parameters = self.fit.model.mechanism.parameters
        sd = np.sqrt(np.diag(self.fit.solution.covariance)) * self.decision.sd_factor
        return tuple(
            Quantity(p.name, float(x * p.shown), float(s * p.shown), p.unit)
            for p, x, s in zip(parameters, self.fit.x[: len(sd)], sd[: len(parameters)], strict=False)
        )

    @cached_property
    def effects(self) -> tuple[FoundEffect, ...]:
        """Effects of the last model, strongest first."""
        d = self.diagnosis
        squares = [float(np.sum(s.fit.residual_mm**2)) for s in d.trace.stages]
        found = []
        for k, finding in enumerate(d.trace.findings):
            amplitudes, covariance = d.last.amplitudes(k)
            term = d.last.model.terms[k]
            found.append(
                FoundEffect(
                    name=_name(term),
                    label=term.effect.label,
                    physics=term.effect.physics,
                    parameters=term.effect.quantities(
                        term.hidden, amplitudes, covariance * self._last_sd_factor**2
                    ),
                    share=(squares[k] - squares[k + 1]) / squares[0],
                    p_value=finding.p_value,
                    probability=None,
                    aliases=tuple(_name(t) for t in finding.aliases),
                    alias_labels=tuple(t.effect.label for t in finding.aliases),
                    # no repair is recommended for an effect that fresh readings contradict
                    remedy=None if self.decision.confirmed is False else term.effect.remedy,
                    experiment=term.effect.experiment,
                )
            )
        return tuple(sorted(found, key=lambda f: -f.share))

    @property
    def _last_sd_factor(self) -> float:
        last = self.diagnosis.last
        adequate = self.diagnosis.trace.adequate
        return 1.0 if adequate else float(np.sqrt(max(last.cost / max(last.dof, 1), 1.0)))

    @cached_property
    def stages(self) -> tuple[StageErrors, ...]:
        """Paper, base, then one per effect."""
        return stage_errors(self.diagnosis)

    @cached_property
    def position_errors(self) -> tuple[PositionError, PositionError]:
        """Predicted over the workspace, mm, with commands of the base model and of the last one.

        Both are relative to the last model, the best available description of the machine.
        """
        d = self.diagnosis
        return position_errors(d.base, d.last, self._last_sd_factor, d.fresh)

    @cached_property
    def true_position_errors(self) -> tuple[PositionError, PositionError] | None:
        """Against a tracker, mm, under the base model and the last one; None where nothing was tracked."""
        d = self.diagnosis
        return true_position_errors(d.base, d.last, d.measurements, d.fresh)

    @cached_property
    def invisible(self) -> tuple[SmallestVisible, ...]:
        """Smallest detectable size of every effect that was not found."""
        return detectable(self.diagnosis.last, effects_of(self.diagnosis.last.model.mechanism))

    @cached_property
    def weak_direction(self) -> WeakDirection:
        """As in an identification, with the effects in the model."""
        mechanism = self.fit.model.mechanism
        return kind_of(mechanism).weak_direction(
            mechanism, self.fit.solution, self.noise.row_sd, self.decision.sd_factor
        )

    @cached_property
    def reason(self) -> Reason:
        """The verdict in one sentence, for every output."""
        return verdict_reason(self.diagnosis, [f.label for f in self.effects])

    @cached_property
    def curves(self) -> tuple[Curve, ...]:
        """Learned curve of each joint that has one in the model."""
        return curves(self.diagnosis.last, self._last_sd_factor)

    @cached_property
    def origin(self) -> str:
        """The trusted stage."""
        return self.stages[self.decision.trusted + 1].model

    @cached_property
    def residual(self) -> ResidualView:
        """The residual of every reading; of several coordinates, its length."""
        d = self.diagnosis
        base, mechanism = d.base, d.base.model.mechanism
        left = [_by_reading(stage.fit) for stage in d.trace.stages]
        c = base.conditions
        return ResidualView(
            before_mm=left[0],
            by_effect_mm=tuple(a - b for a, b in pairwise(left)),
            after_mm=left[-1],
            limit_mm=LIMIT_SDS * _each_reading(d.last, d.last.row_sd),
            theta=c.theta,
            approach=c.approach,
            travel_mm=c.travel,
            temperature_rise_k=c.temperature_rise,
            place_mm=mechanism.places(base.x[: base.model.base_size]),
        )

    @property
    def model(self) -> ModelDocument:
        """The trusted stage, with the effects found."""
        d, trusted = self.diagnosis, self.decision.trusted
        return model_document(
            d,
            self.fit,
            self.decision.sd_factor,
            stage=self.stages[trusted + 1].model,
            confirmed=d.confirmations[trusted].confirmed if d.confirmations else None,
        )


def _name(term: Term) -> EffectName:
    effect = term.effect
    return EffectName(effect=effect.id, joint=effect.joint)


def _by_reading(fit: Fit) -> Real:
    """(K,) mm, residual of each reading; of several coordinates, its length."""
    return _each_reading(fit, fit.residual_mm)


def _each_reading(fit: Fit, rows: Real) -> Real:
    mechanism = fit.model.mechanism
    return rows if len(rows) == len(mechanism.measurements) else by_reading(mechanism, rows)
