"""Whether the station found the error: a comparison of the chosen error with the result of the run."""

from __future__ import annotations

from collections.abc import Sequence

from station.records import CalibrationSummary, DiagnosisDocument, EffectName, Finding, Score, State
from station.service.challenges import Kind

POSSIBLE = 0.05
"""Probability from which an explanation counts as named as possible by the station."""
UNNAMED = "unnamed"
_WORDS = {"scale": ("scale", "readout", "head"), "line": ("drive", "axis", "line", "gateway", "broke while")}
"""Words of a reason for each failed part; a broken line is named by its address."""


def scored(
    kind: Kind, joint: int | None, run: CalibrationSummary, document: DiagnosisDocument | None
) -> Score:
    """See `Exercise.score`."""
    if kind.group == "fault":
        return _of_fault(kind, joint, run)
    if document is None or run.state is not State.SUCCEEDED:
        return "missed" if run.verdict == "pass" and run.outcome == "good" else "noticed"
    if kind.group == "unnamed":
        return _of_unnamed(document)
    return _of_catalogue(kind, joint, document)


def _of_fault(kind: Kind, joint: int | None, run: CalibrationSummary) -> Score:
    if run.state is State.SUCCEEDED:
        return "withstood"
    device = kind.kind.partition(" ")[0]
    words = (f"axis {joint}", f"drive {joint}") if kind.joint else _WORDS[device]
    reason = (run.reason or "").casefold()
    return "found" if any(word in reason for word in words) else "noticed"


def _of_unnamed(document: DiagnosisDocument) -> Score:
    named = [finding for finding in document.findings if finding.effect != UNNAMED]
    if document.verdict == "adequate":
        return "missed"
    if not named:
        return "found"
    return "wrong" if document.confirmed else "noticed"


def _of_catalogue(kind: Kind, joint: int | None, document: DiagnosisDocument) -> Score:
    fitting = [f for f in document.findings if any(_is(name, kind, joint) for name in (f, *f.alias_set))]
    others = [f for f in document.findings if f not in fitting and f.effect != UNNAMED]
    if fitting:
        return "partly" if others else "found"
    if _possible(kind, joint, document):
        return "partly"
    if _blames(others, document):
        return "wrong"
    return "missed" if document.verdict == "adequate" else "noticed"


def _possible(kind: Kind, joint: int | None, document: DiagnosisDocument) -> bool:
    return any(
        _is(effect, kind, joint)
        for explanation in document.explanations
        if explanation.probability >= POSSIBLE
        for effect in explanation.effects
    )


def _blames(others: Sequence[Finding], document: DiagnosisDocument) -> bool:
    return bool(others) and (document.confirmed is True or document.verdict == "explained")


def _is(name: EffectName, kind: Kind, joint: int | None) -> bool:
    """Whether a cause is at a joint, by its number or by a link attached to it."""
    if name.effect != kind.kind:
        return False
    return joint is None or name.joint == joint or (name.part or "").endswith(str(joint))
