"""The verdict on a set of explanations in one sentence."""

from __future__ import annotations

from collections.abc import Sequence

from station.diagnosis.explanations import Explanation
from station.diagnosis.naming import named
from station.diagnosis.search import Hint
from station.diagnosis.weighed_loop import WeighedDiagnosis
from station.records import ExperimentRecord, Phrase, Reason, because, phrase

WORTH_SAYING = 0.02
MOST_OTHERS = 3
LOUD = 2.0
"""Noise over the specification above which the readings count as scattered."""


def weighed_reason(
    diagnosis: WeighedDiagnosis,
    labels: Sequence[str],
    share: float,
    hints: Sequence[Hint],
    experiments: Sequence[ExperimentRecord],
) -> Reason:
    """The reason for the verdict; `labels` of the named effects found, strongest first."""
    d = diagnosis
    mistake = d.mistake or d.entry
    causes = " and ".join(labels)
    percent = 100.0 * share
    depends_on = hints[0].depends_on if hints else "nothing"
    match d.verdict:
        case "adequate" | "explained" if d.spoilt:
            code = f"{d.verdict}_mistake"
        case "adequate" | "explained" if d.confirmed is False:
            code = f"{d.verdict}_not_verified"
        case "adequate" | "explained":
            code = f"{d.verdict}_confirmed" if d.confirmed else d.verdict
        case "ambiguous":
            return _ambiguous(d, experiments)
        case "partly_explained" if not _refuted(d):
            return because("partly_explained", causes=causes, share_percent=percent, depends_on=depends_on)
        case _:
            return _unexplained(d, causes, percent, depends_on)
    text = "" if mistake is None else mistake.said
    return because(code, causes=causes, share_percent=percent, text=text)


def _refuted(d: WeighedDiagnosis) -> bool:
    validation = d.found.validation
    return validation is not None and validation.new and not validation.agrees


def _ambiguous(d: WeighedDiagnosis, experiments: Sequence[ExperimentRecord]) -> Reason:
    first, *others = d.found.explanations
    best: Phrase | str = ""
    if experiments:
        useful = experiments[0]
        assert useful.said is not None
        best = phrase("most_useful", percent=100.0 * useful.decides, experiment=useful.said)
    return because(
        "ambiguous",
        causes=_words(first),
        probability_percent=100.0 * first.probability,
        others=_listed([one for one in others if one.probability >= WORTH_SAYING][:MOST_OTHERS]),
        experiment=best,
    )


def _listed(others: Sequence[Explanation]) -> Phrase:
    """Explanations with their probabilities."""
    if not others:
        return phrase("other_explanations")
    first, *rest = others
    share = phrase("share", causes=_words(first), percent=100.0 * first.probability)
    return phrase("followed_by", first=share, rest=_listed(rest)) if rest else share


def _unexplained(d: WeighedDiagnosis, causes: str, percent: float, depends_on: str) -> Reason:
    mistake = (d.mistake if d.spoilt else None) or d.entry
    if mistake is not None:
        return because("unexplained_mistake", depends_on=depends_on, text=mistake.said)
    if d.found.loudness > LOUD:
        return because("scattering", times=d.found.loudness)
    unnamed = [e for e in d.found.explanations if not e.named]
    if _refuted(d) and causes:
        return because("unexplained_refuted", causes=causes, share_percent=percent, depends_on=depends_on)
    if _refuted(d) and not unnamed:
        return because("adequate_refuted")
    if unnamed:
        return because("unexplained_unnamed", depends_on=depends_on, unnamed=_words(unnamed[0]))
    if causes:
        return because("unexplained_nearest", causes=causes, depends_on=depends_on)
    return because("unexplained", depends_on=depends_on)


def _words(one: Explanation) -> str:
    labels = [named(held.part.key, held.depends_on).label for held in one.errors]
    return " and ".join(dict.fromkeys(labels)) or "no effect at all"
