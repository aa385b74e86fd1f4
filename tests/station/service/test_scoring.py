"""Whether the station found it: every score from what a run may say."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Any

import pytest

from station.records import CalibrationSummary, DiagnosisDocument, Finding
from station.records.diagnosis_document import EffectName, ExplainedEffect, ExplanationRecord
from station.service import KINDS
from station.service.scoring import scored


def run(state: str = "succeeded", outcome: str = "repair", **more: Any) -> CalibrationSummary:
    given: dict[str, Any] = {"verdict": None, "reason": None, "state": state, "outcome": outcome, **more}
    return CalibrationSummary(
        id=1, uid="u", robot_serial="R", kind="diagnose", plan="diagnostic", operator="ada",
        created_at=datetime(2026, 1, 1, tzinfo=UTC), **given,
    )  # fmt: skip


def finding(effect: str, joint: int | None = None, *aliases: str, part: str | None = None) -> Finding:
    names = tuple(EffectName(effect=alias, joint=joint) for alias in aliases)
    return Finding(
        effect=effect, joint=joint, part=part, label=effect, parameters=(), share=1.0, p_value=0.0,
        alias_set=names, remedy="",
    )  # fmt: skip


def document(
    verdict: str, *findings: Finding, confirmed: bool | None = True, **more: Any
) -> DiagnosisDocument:
    given = {"explanations": (), **more}
    return DiagnosisDocument.model_construct(verdict=verdict, findings=findings, confirmed=confirmed, **given)


def doubtful(probability: float) -> DiagnosisDocument:
    """Nothing is found; backlash of joint 1 is so probable."""
    one = ExplainedEffect(effect="backlash", joint=1, label="backlash", parameters=())
    explanation = ExplanationRecord(effects=(one,), probability=probability, named=True)
    return document("ambiguous", confirmed=False, explanations=(explanation,))


@pytest.mark.parametrize(
    ("kind", "joint", "said", "score"),
    [
        ("backlash", 1, document("explained", finding("backlash", 1)), "found"),
        ("backlash", 1, document("explained", finding("compliance", 1, "backlash")), "found"),
        ("backlash", 1, document("explained", finding("backlash", 2)), "wrong"),
        ("backlash", 1, document("explained", finding("backlash", 1), finding("drift")), "partly"),
        ("backlash", 1, doubtful(0.3), "partly"),
        ("backlash", 1, doubtful(0.01), "noticed"),
        ("backlash", 1, document("partly_explained", finding("drift"), confirmed=False), "noticed"),
        ("backlash", 1, document("adequate"), "missed"),
        ("link_length", 2, document("explained", finding("link_length", part="L2")), "found"),
        ("link_length", 2, document("explained", finding("link_length", part="L1")), "wrong"),
        ("base_flex", None, document("unexplained", confirmed=False), "found"),
        ("base_flex", None, document("explained", finding("unnamed")), "found"),
        ("base_flex", None, document("explained", finding("scale_bow")), "wrong"),
        ("base_flex", None, document("ambiguous", finding("scale_bow"), confirmed=False), "noticed"),
        ("base_flex", None, document("adequate"), "missed"),
    ],
)  # fmt: skip
def test_an_error_of_the_machine(kind: str, joint: int | None, said: DiagnosisDocument, score: str) -> None:
    assert scored(KINDS[kind], joint, run(), said) == score


def test_a_calibration_without_a_diagnosis() -> None:
    assert scored(KINDS["drift"], None, run(outcome="good", verdict="pass"), None) == "missed"
    assert scored(KINDS["drift"], None, run(verdict="fail"), None) == "noticed"


@pytest.mark.parametrize(
    ("kind", "joint", "state", "reason", "score"),
    [
        ("scale silent", None, "failed", "The linear scale does not answer; check cable.", "found"),
        ("axis frozen", 2, "failed", "P3: servo axis 2 did not arrive.", "found"),
        ("axis frozen", 2, "failed", "P3: servo axis 1 did not arrive.", "noticed"),
        ("line bad_crc", None, "failed", "Drive 1 sent a frame with a wrong check sum.", "found"),
        ("line bad_crc", None, "succeeded", None, "withstood"),
    ],
)
def test_a_fault(kind: str, joint: int | None, state: str, reason: str | None, score: str) -> None:
    assert scored(KINDS[kind], joint, run(state, "failed", reason=reason), None) == score
