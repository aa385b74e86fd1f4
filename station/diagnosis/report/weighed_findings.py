"""All results of a set of explanations, and its document (schema station.diagnosis/2)."""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np
from scipy.special import chdtrc

from station.diagnosis.decision import Decision
from station.diagnosis.experiments import rated
from station.diagnosis.explanations import Held, Step, steps
from station.diagnosis.learned import mixture_document
from station.diagnosis.naming import name_record, named
from station.diagnosis.report.detectability import detectable
from station.diagnosis.report.findings import Findings, FoundEffect, ResidualView
from station.diagnosis.report.joint_curves import Curve
from station.diagnosis.report.stages import base_unknowns, errors_of, simplest
from station.diagnosis.report.tracked import true_errors_of_set
from station.diagnosis.report.unnamed_curves import unnamed_curves
from station.diagnosis.report.weighed_sentence import weighed_reason
from station.diagnosis.search import Hint, hints
from station.diagnosis.tests_of_fit import whitened_residual
from station.diagnosis.weighed_loop import WeighedDiagnosis
from station.effects import five_bar_catalogue
from station.fitting import (
    MINIMUM_DOF,
    ErrorFields,
    Noise,
    NotConvergedError,
    Solution,
    pure_error,
    tolerance_prior,
)
from station.five_bar import GRID, describe_weak_direction, inverse
from station.model import Fit, Model, fit
from station.records import (
    LIMIT_SDS,
    Complex,
    EffectName,
    ExperimentRecord,
    ExplainedEffect,
    ExplanationRecord,
    FreshReading,
    MistakeRecord,
    MixtureDocument,
    PositionError,
    Quantity,
    Reason,
    SmallestVisible,
    StageErrors,
    WeakDirection,
    phrase,
)


class WeighedFindings(Findings):
    """Results of all explanations together; the stages lead to the reported one."""

    schema = "station.diagnosis/2"

    def __init__(self, diagnosis: WeighedDiagnosis) -> None:
        self.diagnosis = diagnosis
        self.found = diagnosis.found
        self.robot = diagnosis.robot
        self.measurements = diagnosis.measurements
        self.outliers = diagnosis.outliers
        self.fresh_outliers = diagnosis.fresh_outliers
        self.mechanism = diagnosis.found.mechanism.of(diagnosis.measurements)

    @property
    def decision(self) -> Decision:
        """Verdict and confirmation."""
        return self.diagnosis.decision

    @property
    def origin(self) -> None:
        """The whole set."""
        return None

    @cached_property
    def zeros_only_bound_mm(self) -> float | None:
        """Bound under the whole set."""
        mixture = self.found.mixture
        place = mixture.mechanism.robot.workspace_grid(*GRID)
        theta = inverse(mixture.mechanism.nominal, place) - mixture.mean[:2]
        return mixture.position_error(theta, place).bound_95

    def error_fields(self, places: Complex) -> ErrorFields:
        """Errors under the whole set."""
        mixture = self.found.mixture
        theta = inverse(mixture.mechanism.nominal, places)
        before, _ = mixture.errors_at(theta, places)
        after, drawn = mixture.errors_at(theta - mixture.mean[:2], places)
        return ErrorFields(before, after, np.quantile(drawn, 0.95, axis=1))

    @cached_property
    def fresh(self) -> tuple[FreshReading, ...]:
        """Under the reported explanation, where that determines the predictions."""
        fresh, residual_mm = self.diagnosis.fresh, self.steps[-1].fresh_mm
        if fresh is None or residual_mm is None:
            return ()
        places = self.mechanism.of(fresh).places(self.found.mixture.mean)
        return tuple(
            FreshReading(reading=int(i), x_mm=float(x), y_mm=float(y), residual_mm=float(r))
            for i, (x, y), r in zip(fresh.ids, places, residual_mm, strict=True)
            if np.isfinite(r)
        )

    @cached_property
    def curves(self) -> tuple[Curve, ...]:
        """Curve of each joint with an unnamed error."""
        return unnamed_curves(self.found)

    @property
    def mistake(self) -> MistakeRecord | None:
        """A wrong label, or glitches, that were excluded."""
        mistake = self.diagnosis.mistake
        return None if mistake is None else mistake.record()

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The base model, then one error after another."""
        return steps(self.found, self.diagnosis.measurements, self.diagnosis.fresh)

    @cached_property
    def added(self) -> tuple[str, ...]:
        """Labels of the errors, one after another."""
        return tuple(" and ".join(_labels(step.errors)) for step in self.steps[1:])

    @cached_property
    def noise(self) -> Noise:
        """Scatter of the repeats, otherwise of the readings."""
        last = self.steps[-1]
        square, dof = pure_error(self.measurements, last.solution.residual)
        source: Literal["repeats", "specification"] = "repeats" if dof >= MINIMUM_DOF else "specification"
        if source == "specification" or square == 0.0:
            return Noise(last.row_sd, "specification", 0)
        return Noise(last.row_sd * float(np.sqrt(square / dof)), source, dof)

    @cached_property
    def parameters(self) -> tuple[Quantity, ...]:
        """Base parameters of the mixture."""
        return self.found.parameters

    @cached_property
    def shares(self) -> tuple[float, ...]:
        """Share of the base residual's sum of squares that each step took."""
        squares = [float(np.sum(step.residual_mm**2)) for step in self.steps]
        return tuple((a - b) / squares[0] for a, b in pairwise(squares))

    @cached_property
    def effects(self) -> tuple[FoundEffect, ...]:
        """Named effects of the reported explanation, strongest first."""
        if self.decision.verdict == "adequate":
            return ()
        out = []
        for finding in self.found.findings:
            at = next(
                k
                for k, step in enumerate(self.steps)
                if finding.part.key in [held.part.key for held in step.errors]
            )
            step, before = self.steps[at], self.steps[at - 1]
            chi2 = max(before.settled.cost - step.settled.cost, 0.0) / step.settled.level**2
            naming = named(finding.part.key)
            aliases = [named(key) for key in finding.alias_set]
            remedy, entry = naming.remedy, self.diagnosis.entry
            if entry is not None:
                remedy = phrase("sentences", first=remedy, second=entry.said)
            out.append(
                FoundEffect(
                    name=name_record(finding.part.key),
                    label=naming.label,
                    physics=naming.physics,
                    parameters=next(h.parameters for h in step.errors if h.part.key == finding.part.key),
                    share=self.shares[at - 1] / len(step.errors),
                    p_value=float(chdtrc(step.settled.families[-1].width, chi2)),
                    probability=min(finding.probability, 1.0),
                    aliases=tuple(name_record(key) for key in finding.alias_set),
                    alias_labels=tuple(alias.label for alias in aliases),
                    remedy=remedy,
                    experiment=naming.experiment,
                )
            )
        return tuple(sorted(out, key=lambda f: -f.share))

    @cached_property
    def stages(self) -> tuple[StageErrors, ...]:
        """Paper, base, then one more error each."""
        base = self.steps[0]
        unknowns = base_unknowns(self.mechanism)
        out = [
            simplest(self.mechanism, base.row_sd, base.settled.x[: base.settled.size], self.diagnosis.fresh)
        ]
        for name, step in zip(("base", *(f"+ {label}" for label in self.added)), self.steps, strict=True):
            unknowns += sum(len(held.parameters) for held in step.errors)
            if step.errors and step.errors[0].depends_on is not None:
                unknowns += step.settled.families[-1].width
            fresh = None if step.fresh_mm is None else np.abs(step.fresh_mm[np.isfinite(step.fresh_mm)])
            fresh = None if fresh is None or not len(fresh) else fresh
            out.append(errors_of(name, unknowns, step.solution, step.row_sd, self.mechanism, fresh))
        return tuple(out)

    @cached_property
    def position_errors(self) -> tuple[PositionError, PositionError]:
        """Over the workspace, mm, with commands of the base model and with those of the set."""
        before, after = (
            PositionError(rms=e.rms, max=e.max, bound_95=e.bound_95) for e in self.found.position_error
        )
        return before, after

    @cached_property
    def true_position_errors(self) -> tuple[PositionError, PositionError] | None:
        """Against a tracker, mm, under the base model and the set."""
        return true_errors_of_set(self.found, self.diagnosis.measurements, self.diagnosis.fresh)

    @cached_property
    def base_fit(self) -> Fit | None:
        """The base model by least squares; None where it does not converge."""
        mechanism = self.found.mechanism
        model = Model(mechanism, self.found.weighing.reference)
        level = self.found.weighing.best.level
        try:
            return fit(model, tolerance_prior(mechanism), self.found.weighing.frame.row_sd * level)
        except NotConvergedError:
            return None

    @cached_property
    def invisible(self) -> tuple[SmallestVisible, ...]:
        """Smallest detectable size of every effect that was not found."""
        if self.base_fit is None:
            return ()
        found = {effect.label for effect in self.effects}
        return tuple(one for one in detectable(self.base_fit, five_bar_catalogue()) if one.label not in found)

    @cached_property
    def hints(self) -> tuple[Hint, ...]:
        """The quantities that the base model's residual depends on, where it is not explained."""
        if self.decision.verdict in ("adequate", "explained") or self.base_fit is None:
            return ()
        return hints(whitened_residual(self.base_fit))

    @cached_property
    def weak_direction(self) -> WeakDirection:
        """As in an identification, for the mixture."""
        nothing = np.zeros(0)
        mixture = self.found.mixture
        solution = Solution(
            x=mixture.mean, covariance=mixture.covariance, singular_values=nothing, directions=nothing,
            scale=nothing, cost=0.0, residual=nothing, jacobian=nothing, steps=0,
        )  # fmt: skip
        return describe_weak_direction(self.mechanism, solution, self.noise.row_sd, 1.0)

    @cached_property
    def explanations(self) -> tuple[ExplanationRecord, ...]:
        """All explanations with a probability of 0.01 or more."""
        return tuple(
            ExplanationRecord(
                effects=tuple(_explained(held) for held in one.errors),
                probability=min(one.probability, 1.0),
                named=one.named,
            )
            for one in self.found.explanations
        )

    @cached_property
    def experiments(self) -> tuple[ExperimentRecord, ...]:
        """Experiments that could distinguish the explanations, best first."""
        if self.decision.verdict != "ambiguous":
            return ()
        return tuple(
            ExperimentRecord(kind=one.kind, text=one.said.text(), said=one.said, decides=one.decides)
            for one in rated(self.found)
        )

    @cached_property
    def residual(self) -> ResidualView:
        """The residual of every reading that was learned on."""
        first, last = self.steps[0], self.steps[-1]
        left = [step.residual_mm for step in self.steps]
        s = first.situation
        return ResidualView(
            before_mm=left[0],
            by_effect_mm=tuple(a - b for a, b in pairwise(left)),
            after_mm=left[-1],
            limit_mm=LIMIT_SDS * last.row_sd,
            theta=s.theta,
            approach=s.approach,
            travel_mm=s.travel,
            temperature_rise_k=s.rise,
            place_mm=self.mechanism.places(first.settled.x[: first.settled.size]),
        )

    @cached_property
    def reason(self) -> Reason:
        """The verdict in one sentence, for every output."""
        return weighed_reason(
            self.diagnosis,
            [effect.label for effect in self.effects],
            sum(self.shares),
            self.hints,
            self.experiments,
        )

    @property
    def model(self) -> MixtureDocument:
        """The set itself."""
        return mixture_document(self.diagnosis, stage=self.stages[-1].model)


def _labels(errors: tuple[Held, ...]) -> list[str]:
    return [named(held.part.key, held.depends_on).label for held in errors]


def _explained(held: Held) -> ExplainedEffect:
    key = held.part.key
    name: EffectName = name_record(key)
    if held.depends_on is not None:
        joint = {"joint1": 1, "joint2": 2}.get(held.depends_on)
        name = EffectName(effect="unnamed", joint=joint, part=held.depends_on)
    return ExplainedEffect(
        effect=name.effect,
        joint=name.joint,
        part=name.part,
        label=named(key, held.depends_on).label,
        parameters=held.parameters,
        depends_on=held.depends_on,
    )
