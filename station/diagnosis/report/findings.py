"""The results of one diagnosis, whichever search made it: the figures of documents, pages and tables."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from station.diagnosis.decision import Decision
from station.diagnosis.report.joint_curves import Curve
from station.diagnosis.search import Hint
from station.fitting import ErrorFields, Noise, Outlier
from station.machines import AnyRobot, kind_of
from station.records import (
    AnyModelDocument,
    Complex,
    DataSource,
    Dependence,
    DiagnosisDocument,
    DiagnosisSchema,
    EffectName,
    ExperimentRecord,
    ExplanationRecord,
    Finding,
    FreshReading,
    Measurements,
    MistakeRecord,
    Phrase,
    PositionError,
    Quantity,
    Real,
    Reason,
    SmallestVisible,
    StageAccuracy,
    StageErrors,
    WeakDirection,
)


@dataclass(frozen=True)
class FoundEffect:
    """One effect as reported."""

    name: EffectName
    label: str
    physics: Phrase
    parameters: tuple[Quantity, ...]
    share: float
    """Share of the base residual's sum of squares that this effect took."""
    p_value: float
    probability: float | None
    """Probability that it or one of its aliases is present; None where the search weighs no alternatives."""
    aliases: tuple[EffectName, ...]
    """Effects that these readings cannot distinguish from it,"""
    alias_labels: tuple[str, ...]
    """and their labels."""
    remedy: Phrase | None
    """With the wrong entry of the robot file that may be the cause instead; None if fresh readings contradict
    the effect.
    """
    experiment: Phrase
    """The experiment that distinguishes it from its aliases."""

    def record(self) -> Finding:
        """The effect as the document contains it."""
        experiment = self.experiment if self.aliases else None
        return Finding(
            effect=self.name.effect,
            joint=self.name.joint,
            part=self.name.part,
            label=self.label,
            parameters=self.parameters,
            share=self.share,
            p_value=self.p_value,
            probability=self.probability,
            alias_set=(self.name, *self.aliases),
            remedy=self.remedy.text() if self.remedy else "",
            remedy_said=self.remedy,
            separating_experiment=None if experiment is None else experiment.text(),
            separating_experiment_said=experiment,
        )


@dataclass(frozen=True)
class ResidualView:
    """The residual of every reading that was learned on, with all quantities it may be ordered by."""

    before_mm: Real
    """(K,) under the base model."""
    by_effect_mm: tuple[Real, ...]
    """(K,) contribution of each effect, in the order in which they were added."""
    after_mm: Real
    """(K,)"""
    limit_mm: Real
    """(K,) limit that noise alone hardly exceeds."""
    theta: Real
    """(K, n) rad, zero offsets included."""
    approach: Real
    """(K, n)"""
    travel_mm: Real
    temperature_rise_k: Real | None
    place_mm: Real
    """(K, 2 or 3)"""


class Findings(ABC):
    """All results of one diagnosis, each figure computed once."""

    schema: DiagnosisSchema
    """Schema of the document."""
    robot: AnyRobot
    measurements: Measurements
    """The readings that were used, without fresh ones."""
    outliers: tuple[Outlier, ...]
    fresh_outliers: tuple[int | str, ...]

    @property
    @abstractmethod
    def decision(self) -> Decision:
        """Verdict, confirmation, and consequences."""

    @property
    def zeros_only_bound_mm(self) -> float | None:
        """Bound on the position error with 95 % probability, if the drives get the zero offsets and nothing
        else is compensated; None where unknown.
        """
        return None

    @property
    def fresh(self) -> tuple[FreshReading, ...]:
        """Readings that were not used in the fit; empty where none are shown on a map."""
        return ()

    def error_fields(self, places: Complex) -> ErrorFields | None:
        """Position errors at positions (G,), mm, with the zero offsets in the drives and nothing else
        compensated; None where unknown.

        :raises Unreachable: naming the first position out of reach.
        """
        return None

    @property
    @abstractmethod
    def noise(self) -> Noise:
        """The noise with which the readings were judged."""

    @property
    @abstractmethod
    def parameters(self) -> tuple[Quantity, ...]:
        """Base parameters in shown units, zero offsets first."""

    @property
    @abstractmethod
    def origin(self) -> str | None:
        """The stage that the parameters belong to; None where they are the mean over all explanations."""

    @property
    @abstractmethod
    def weak_direction(self) -> WeakDirection:
        """The direction that the readings determine least."""

    @property
    @abstractmethod
    def effects(self) -> tuple[FoundEffect, ...]:
        """Named effects, strongest first."""

    @property
    @abstractmethod
    def added(self) -> tuple[str, ...]:
        """Labels of the additions to the base model, stage by stage."""

    @property
    @abstractmethod
    def stages(self) -> tuple[StageErrors, ...]:
        """Paper, base, then one stage per addition."""

    @property
    @abstractmethod
    def position_errors(self) -> tuple[PositionError, PositionError]:
        """Predicted, mm, with the commands of the base model and of the result."""

    @property
    @abstractmethod
    def true_position_errors(self) -> tuple[PositionError, PositionError] | None:
        """Against a tracker, mm; None where nothing was tracked."""

    @property
    @abstractmethod
    def hints(self) -> tuple[Hint, ...]:
        """The quantities that an unexplained residual depends on."""

    @property
    @abstractmethod
    def invisible(self) -> tuple[SmallestVisible, ...]:
        """Smallest detectable size of every effect that was not found."""

    @property
    @abstractmethod
    def curves(self) -> tuple[Curve, ...]:
        """Learned curve of each joint that has one in the model."""

    @property
    @abstractmethod
    def residual(self) -> ResidualView:
        """The residual of every reading."""

    @property
    @abstractmethod
    def reason(self) -> Reason:
        """The verdict in one sentence, for every output."""

    @property
    def explanations(self) -> tuple[ExplanationRecord, ...]:
        """Most probable first; empty where none were weighed."""
        return ()

    @property
    def experiments(self) -> tuple[ExperimentRecord, ...]:
        """Experiments that could distinguish the explanations, best first."""
        return ()

    @property
    def mistake(self) -> MistakeRecord | None:
        """A mistake in the file that did not lead to a refusal."""
        return None

    @property
    @abstractmethod
    def model(self) -> AnyModelDocument:
        """The model that commands are computed from."""

    def document(self, data: DataSource) -> DiagnosisDocument:
        """The contract's document; `data` states what it was made from."""
        before, after = self.position_errors
        true_before, true_after = self.true_position_errors or (None, None)
        return DiagnosisDocument(
            schema_=self.schema,
            data=data,
            noise=self.noise.record(),
            verdict=self.decision.verdict,
            confirmed=self.decision.confirmed,
            sentence=self.sentence,
            parameters=self.parameters,
            weak_direction=self.weak_direction,
            findings=tuple(effect.record() for effect in self.effects),
            curves=tuple(curve.record() for curve in self.curves),
            stages=self.stages,
            before=_accuracy(self.stages[1], before, true_before),
            after=_accuracy(self.stages[-1], after, true_after),
            hints=_dependences(self.hints),
            invisible=self.invisible,
            outliers=tuple(outlier.reading for outlier in self.outliers),
            outlier_reasons=tuple(outlier.reason for outlier in self.outliers),
            outlier_reasons_said=tuple(outlier.said for outlier in self.outliers),
            fresh_outliers=self.fresh_outliers,
            explanations=self.explanations,
            experiments=self.experiments,
            mistake=self.mistake,
            model=self.model,
        )

    @property
    def sentence(self) -> str:
        """The verdict in English."""
        return self.reason.text

    @property
    def extent(self) -> Literal["workspace", "measured poses"]:
        """The region over which position errors are predicted."""
        return kind_of(self.robot).extent


def _dependences(found: Sequence[Hint]) -> tuple[Dependence, ...]:
    """The dependences as the document contains them."""
    return tuple(
        Dependence(depends_on=h.depends_on, strength=h.strength, text=h.said.text(), said=h.said)
        for h in found
    )


def _accuracy(stage: StageErrors, predicted: PositionError, true: PositionError | None) -> StageAccuracy:
    """A stage with its position error."""
    return StageAccuracy(**dict(stage), predicted_position_error_mm=predicted, true_position_error_mm=true)
