"""Everything that is said of one diagnosis, and its document (schema station.diagnosis/1)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from station.diagnosis.closed_loop import Diagnosis
from station.diagnosis.decision import Decision
from station.diagnosis.learned import model_document
from station.diagnosis.report.detectability import detectable
from station.diagnosis.report.joint_curves import curves
from station.diagnosis.report.predicted_error import position_errors
from station.diagnosis.report.sentence import verdict_reason
from station.diagnosis.report.stages import stage_errors
from station.diagnosis.report.tracked import true_position_errors
from station.fitting import Noise
from station.machines import effects_of, kind_of
from station.model import Fit, Term
from station.records import (
    DataSource,
    Dependence,
    DiagnosisDocument,
    EffectName,
    Finding,
    PositionError,
    Quantity,
    Reason,
    SmallestVisible,
    StageAccuracy,
    StageErrors,
    WeakDirection,
)


@dataclass(frozen=True)
class FoundEffect:
    """One effect of the last model as it is reported."""

    term: Term
    parameters: tuple[Quantity, ...]
    share: float
    """Of the base residual's square that this effect took."""
    p_value: float
    aliases: tuple[Term, ...]

    def record(self) -> Finding:
        """As the document shows it."""
        effect = self.term.effect
        return Finding(
            effect=effect.id,
            joint=effect.joint,
            label=effect.label,
            parameters=self.parameters,
            share=self.share,
            p_value=self.p_value,
            alias_set=tuple(
                EffectName(effect=t.effect.id, joint=t.effect.joint) for t in (self.term, *self.aliases)
            ),
            remedy=effect.remedy,
            separating_experiment=effect.experiment if self.aliases else None,
        )


class Findings:
    """Everything that is said of one diagnosis, each figure computed once."""

    def __init__(self, diagnosis: Diagnosis) -> None:
        self.diagnosis = diagnosis

    @property
    def decision(self) -> Decision:
        """Verdict and trusted stage."""
        return self.diagnosis.decision

    @property
    def fit(self) -> Fit:
        """Of the trusted stage."""
        return self.diagnosis.trace.stages[self.decision.trusted].fit

    @cached_property
    def noise(self) -> Noise:
        """Of the last stage."""
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
                    term,
                    term.effect.quantities(term.hidden, amplitudes, covariance * self._last_sd_factor**2),
                    (squares[k] - squares[k + 1]) / squares[0],
                    finding.p_value,
                    finding.aliases,
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

        Both against the last model as the best that is known of the machine.
        """
        return position_errors(self.diagnosis.base, self.diagnosis.last, self._last_sd_factor)

    @cached_property
    def true_position_errors(self) -> tuple[PositionError, PositionError] | None:
        """Against a tracker, mm, under the base model and the last one; None where nothing was tracked."""
        d = self.diagnosis
        return true_position_errors(d.base, d.last, d.measurements, d.fresh)

    @cached_property
    def invisible(self) -> tuple[SmallestVisible, ...]:
        """Smallest visible size of everything that was not found."""
        return detectable(self.diagnosis.last, effects_of(self.diagnosis.last.model.mechanism))

    @cached_property
    def weak_direction(self) -> WeakDirection:
        """As of an identification, with the effects in the model."""
        mechanism = self.fit.model.mechanism
        return kind_of(mechanism).weak_direction(
            mechanism, self.fit.solution, self.noise.row_sd, self.decision.sd_factor
        )

    @cached_property
    def reason(self) -> Reason:
        """The verdict in one sentence, for every output."""
        return verdict_reason(self.diagnosis, [f.term.effect.label for f in self.effects])

    @property
    def sentence(self) -> str:
        """The same in English."""
        return self.reason.text

    def document(self, data: DataSource) -> DiagnosisDocument:
        """The contract's document; `data` says what it was made from."""
        d, trusted = self.diagnosis, self.decision.trusted
        before, after = self.position_errors
        true_before, true_after = self.true_position_errors or (None, None)
        return DiagnosisDocument(
            data=data,
            noise=self.noise.record(),
            verdict=d.verdict,
            confirmed=d.confirmed,
            sentence=self.sentence,
            parameters=self.parameters,
            weak_direction=self.weak_direction,
            findings=tuple(f.record() for f in self.effects),
            curves=tuple(c.record() for c in curves(d.last, self._last_sd_factor)),
            stages=self.stages,
            before=_accuracy(self.stages[1], before, true_before),
            after=_accuracy(self.stages[-1], after, true_after),
            hints=tuple(
                Dependence(depends_on=h.depends_on, strength=h.strength, text=h.text) for h in d.hints
            ),
            invisible=self.invisible,
            outliers=tuple(o.reading for o in d.outliers),
            outlier_reasons=tuple(o.reason for o in d.outliers),
            fresh_outliers=d.confirmations[-1].left_out if d.confirmations else (),
            model=model_document(
                d,
                self.fit,
                self.decision.sd_factor,
                stage=self.stages[trusted + 1].model,
                confirmed=d.confirmations[trusted].confirmed if d.confirmations else None,
            ),
        )


def _accuracy(stage: StageErrors, predicted: PositionError, true: PositionError | None) -> StageAccuracy:
    return StageAccuracy(**dict(stage), predicted_position_error_mm=predicted, true_position_error_mm=true)
