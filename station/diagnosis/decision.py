"""The decision: the verdict, and the stage that parameters and commands are taken from.

It uses only plain figures of each stage, so that it can be read and tested separately from their computation.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from station.records import DiagnosisVerdict, Outcome

GOOD_SHARE = 0.5
"""An effect that takes less of the residual's sum of squares than this explains nothing by itself."""


@dataclass(frozen=True, slots=True)
class StageFigures:
    """The figures of one stage: the base model, or the model after a further effect."""

    adequate: bool
    """The model fits the readings."""
    fit_ratio: float
    """Mean square of the whitened residual (cost over degrees of freedom)."""
    confirmed: bool | None = None
    """Whether it predicts fresh readings; None without any."""
    fresh_rms_mm: float | None = None
    fresh_ratio: float | None = None
    """Mean square of the fresh residuals over their predicted variance."""


@dataclass(frozen=True, slots=True)
class Decision:
    """The decision on one residual."""

    verdict: DiagnosisVerdict
    confirmed: bool | None
    """Whether fresh readings confirm the finding; None without any, and never of what is unexplained."""
    trusted: int = 0
    """Index of the stage that parameters and commands are taken from; a set of explanations uses its own."""
    sd_factor: float = 1.0
    """Factor for the uncertainty of the trusted stage where it does not fit or predict."""

    @property
    def passed(self) -> bool:
        """Whether the finding can be relied on: it fits, and nothing contradicts it."""
        return self.verdict in ("adequate", "explained") and self.confirmed is not False

    @property
    def refuted(self) -> bool:
        """Whether the effects of the last model are only an attempt."""
        if self.verdict == "partly_explained":
            return self.confirmed is False
        return self.verdict == "unexplained"

    @property
    def outcome(self) -> Outcome:
        """What the owner of the robot has to do."""
        if self.verdict == "ambiguous":
            return "ambiguous"
        if self.verdict not in ("adequate", "explained"):
            return "unexplained"
        if not self.confirmed:
            return "not_verified"
        return "good" if self.verdict == "adequate" else "repair"


def decide(stages: Sequence[StageFigures], *, alternative: bool, share: float) -> Decision:
    """Decide on the stages of a search: the base model first, then one stage for each effect found.

    :param alternative: an unnamed dependence makes the readings about as probable as the effects found
    :param share: share of the base residual's sum of squares that the effects account for
    """
    last = stages[-1]
    verdict = _verdict(last, len(stages) > 1, alternative, share)
    trusted = _trusted(stages, verdict)
    # fresh readings that a model predicts within its own uncertainty confirm no cause where none is found
    confirmed = False if last.confirmed and verdict == "unexplained" else last.confirmed
    return Decision(verdict, confirmed, trusted, _sd_factor(stages[trusted]))


def _verdict(last: StageFigures, found: bool, alternative: bool, share: float) -> DiagnosisVerdict:
    fits = last.adequate and last.confirmed is not False
    if not found:
        return "adequate" if fits else "unexplained"
    if fits and not alternative:
        return "explained"
    return "partly_explained" if share >= GOOD_SHARE else "unexplained"


def _trusted(stages: Sequence[StageFigures], verdict: DiagnosisVerdict) -> int:
    """The last stage, unless fresh readings contradict it or nothing was explained.

    Otherwise the stage that predicts fresh readings best; without fresh readings, the base model.
    """
    if stages[-1].confirmed is False:
        rms = [math.inf if s.fresh_rms_mm is None else s.fresh_rms_mm for s in stages]
        return rms.index(min(rms))
    return 0 if verdict == "unexplained" else len(stages) - 1


def _sd_factor(stage: StageFigures) -> float:
    factor = 1.0
    if not stage.adequate:
        factor = max(factor, math.sqrt(stage.fit_ratio))
    if stage.confirmed is False and stage.fresh_ratio is not None:
        factor = max(factor, math.sqrt(stage.fresh_ratio))
    return factor
