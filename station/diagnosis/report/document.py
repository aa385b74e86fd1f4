"""A diagnosis as `station diagnose --json` writes it (schema station.diagnosis/1 of the contract)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from station.diagnosis.closed_loop import Diagnosis
from station.diagnosis.learned import model_json
from station.diagnosis.report.by_machine import position_errors, weak_direction
from station.diagnosis.report.detectability import Detectable, detectable
from station.diagnosis.report.joint_curves import curves
from station.diagnosis.report.stages import StageErrors, stage_errors
from station.diagnosis.report.tracked import PositionError, true_position_errors
from station.diagnosis.tests_of_fit import in_words
from station.fitting import Noise
from station.machines import effects_of
from station.model import Fit, Term
from station.records import Quantity, vars_of

SCHEMA = "station.diagnosis/1"


@dataclass(frozen=True)
class FoundEffect:
    """One effect of the last model as it is reported."""

    term: Term
    parameters: tuple[Quantity, ...]
    share: float
    """Of the base residual's square that this effect took."""
    p_value: float
    aliases: tuple[Term, ...]

    def as_json(self) -> dict[str, Any]:
        effect = self.term.effect
        members = [self.term, *self.aliases]
        return {
            "effect": effect.id,
            "joint": effect.joint,
            "label": effect.label,
            "parameters": [vars_of(q) for q in self.parameters],
            "share": self.share,
            "p_value": self.p_value,
            "alias_set": [{"effect": t.effect.id, "joint": t.effect.joint} for t in members],
            "remedy": effect.remedy,
            "separating_experiment": effect.experiment if self.aliases else None,
        }


class Findings:
    """Everything that is said of one diagnosis, each figure computed once."""

    def __init__(self, diagnosis: Diagnosis) -> None:
        self.diagnosis = diagnosis

    @property
    def passed(self) -> bool:
        """Whether the last model may be relied on: it fits, and fresh readings do not refute it."""
        return self.diagnosis.verdict in ("adequate", "explained") and self.diagnosis.confirmed is not False

    @property
    def refuted(self) -> bool:
        """Whether the effects of the last model are no more than a try."""
        d = self.diagnosis
        return d.verdict == "unexplained" or (d.verdict == "partly_explained" and d.confirmed is False)

    @cached_property
    def trusted(self) -> int:
        """Index of the stage that parameters and commands are taken from.

        The last one, unless fresh readings refute it or nothing was explained: then the one that
        predicts fresh readings best, without any the base model.
        """
        d = self.diagnosis
        last = len(d.trace.stages) - 1
        if d.confirmations and not d.confirmed:
            return int(np.argmin([c.rms_mm for c in d.confirmations]))
        return 0 if d.verdict == "unexplained" else last

    @property
    def fit(self) -> Fit:
        """Of the trusted stage."""
        return self.diagnosis.trace.stages[self.trusted].fit

    @cached_property
    def sd_factor(self) -> float:
        """What its covariance is widened by: residual scatter over noise where it does not fit."""
        d = self.diagnosis
        factor = 1.0
        if not d.trace.stages[self.trusted].adequacy.passed:
            factor = max(factor, float(np.sqrt(self.fit.cost / max(self.fit.dof, 1))))
        if d.confirmations and not d.confirmations[self.trusted].confirmed:
            check = d.confirmations[self.trusted]
            factor = max(factor, float(np.sqrt(np.mean((check.residual_mm / check.sd_mm) ** 2))))
        return factor

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
        sd = np.sqrt(np.diag(self.fit.solution.covariance)) * self.sd_factor
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
    def position_errors(self) -> tuple[dict[str, float], dict[str, float]]:
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
    def invisible(self) -> tuple[Detectable, ...]:
        """Smallest visible size of everything that was not found."""
        return detectable(self.diagnosis.last, effects_of(self.diagnosis.last.model.mechanism))

    @cached_property
    def weak_direction(self) -> dict[str, Any]:
        """As of an identification, with the effects in the model."""
        return weak_direction(self.fit, self.noise, self.sd_factor)

    @property
    def sentence(self) -> str:
        """The verdict in one line."""
        names = " and ".join(f.term.effect.label for f in self.effects)
        model = "them" if len(self.effects) > 1 else "it"
        share = f"{100.0 * self.diagnosis.explained_share:.0f} %"
        match self.diagnosis.verdict:
            case "partly_explained" | "unexplained" if self.diagnosis.rival is not None:
                rival = in_words(self.diagnosis.rival)
                return (
                    f"Not explained: {names} took {share} of the residual's square, but a dependence on "
                    f"{rival} without any name accounts for the readings about as well."
                )
            case "adequate":
                text = "Adequate: the model fits the readings, nothing is missing from it"
            case "explained":
                text = f"Explained: {names}; with {model} the model fits the readings"
            case "partly_explained":
                text = f"Partly explained: {names} took {share} of the residual's square, a rest stays"
            case _:
                text = (
                    "Unexplained: the residual is not noise, and no effect of the catalogue accounts for it"
                )
                adequacy = self.diagnosis.trace.stages[-1].adequacy
                if adequacy.loud:
                    text += f"; repeats scatter {adequacy.loudness:.0f} times more than specified"
                return f"{text}." if not names else f"{text}; {names} came nearest."
        checks = self.diagnosis.confirmations
        if not checks:
            return f"{text}; not confirmed yet by fresh readings."
        return f"{text}; {'fresh readings confirm it' if checks[-1].confirmed else checks[-1].refusal}."

    def as_json(self, data: dict[str, Any]) -> dict[str, Any]:
        """The contract's document; `data` {file, readings, sha256} says what it was made from."""
        d = self.diagnosis
        before, after = self.position_errors
        true_before, true_after = self.true_position_errors or (None, None)
        return {
            "schema": SCHEMA,
            "data": data,
            "noise": self.noise.as_json(),
            "verdict": d.verdict,
            "confirmed": d.confirmed,
            "sentence": self.sentence,
            "parameters": [vars_of(q) for q in self.parameters],
            "weak_direction": self.weak_direction,
            "findings": [f.as_json() for f in self.effects],
            "curves": [c.as_json() for c in curves(d.last, self._last_sd_factor)],
            "stages": [s.as_json() for s in self.stages],
            "before": {
                **self.stages[1].as_json(),
                "predicted_position_error_mm": before,
                "true_position_error_mm": true_before,
            },
            "after": {
                **self.stages[-1].as_json(),
                "predicted_position_error_mm": after,
                "true_position_error_mm": true_after,
            },
            "hints": [{"depends_on": h.depends_on, "strength": h.strength, "text": h.text} for h in d.hints],
            "invisible": [i.as_json() for i in self.invisible],
            "outliers": [o.reading for o in d.outliers],
            "outlier_reasons": [o.reason for o in d.outliers],
            "fresh_outliers": list(d.confirmations[-1].left_out) if d.confirmations else [],
            "model": {
                **model_json(d, self.fit, self.sd_factor),
                "stage": self.stages[self.trusted + 1].model,
                "confirmed": d.confirmations[self.trusted].confirmed if d.confirmations else None,
            },
        }
