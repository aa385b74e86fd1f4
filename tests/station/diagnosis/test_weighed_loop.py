"""What becomes of a five-bar's files: mistakes before and after the explanations, labels left out, ids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.closed_loop import diagnose
from station.diagnosis.decision import Decision
from station.diagnosis.mistakes import MistakeRefused
from station.diagnosis.report.weighed_findings import WeighedFindings
from station.diagnosis.weighed_loop import weighed
from station.records import DataSource, DiagnosisDocument
from tests.station.simulated import ROBOT, Drawn

SOURCE = DataSource(file="walk.csv", readings=120, sha256="0" * 64)


def test_readings_that_are_wrong_are_refused_by_name() -> None:
    machine = Drawn(seed=11)
    sequence = machine.sequence()
    with pytest.raises(MistakeRefused) as refusal:
        diagnose(ROBOT, replace(sequence, distance=-sequence.distance, came_from=None), machine.fresh())
    assert (refusal.value.mistake.kind, str(refusal.value)) == ("scale_sign", refusal.value.mistake.text)


def test_the_same_readings_confirm_nothing() -> None:
    sequence = Drawn(seed=11).sequence()
    with pytest.raises(MistakeRefused) as refusal:
        diagnose(ROBOT, sequence, sequence)
    assert refusal.value.mistake.kind == "same_readings"


def test_a_wrong_label_is_left_out_and_nothing_is_confirmed() -> None:
    machine = Drawn(seed=11)
    sequence = machine.sequence()
    found = weighed(ROBOT, replace(sequence, position=np.zeros_like(sequence.position)), machine.fresh())
    assert found.mistake is not None and found.mistake.kind == "position_labels"
    assert (found.verdict, found.confirmed, found.decision.outcome) == ("adequate", False, "not_verified")
    assert len(np.unique(found.measurements.position)) == len(sequence)


def test_fresh_readings_may_use_the_ids_of_the_sequence() -> None:
    machine = Drawn(seed=11)
    sequence, fresh = machine.sequence(), machine.fresh()
    fresh.distance[3] += 0.2
    found = weighed(ROBOT, sequence, replace(fresh, ids=sequence.ids[: len(fresh)]))
    assert found.outliers == ()
    assert found.mistake is None or found.mistake.file == "fresh"
    assert len(found.measurements) == len(sequence)
    assert found.fresh is not None and "fresh 4" not in found.fresh.ids


def test_a_document_survives_its_journey() -> None:
    machine = Drawn({"kind": "encoder_eccentricity", "joint": 1, "amplitude_deg": 0.05}, seed=2)
    findings = WeighedFindings(weighed(ROBOT, machine.sequence(), machine.fresh()))
    document = findings.document(SOURCE)
    text = document.model_dump_json(by_alias=True)
    assert DiagnosisDocument.model_validate_json(text).model_dump_json(by_alias=True) == text
    assert sum(one.probability for one in document.explanations) == pytest.approx(1.0, abs=0.1)
    probabilities = [one.probability for one in document.explanations]
    assert probabilities == sorted(probabilities, reverse=True)
    if document.verdict == "ambiguous":
        kinds = {one.kind for one in document.experiments}
        by_hand = {"second_mount", "joint_reference", "payload", "warm_up", "scale_start", "gauge"}
        assert kinds == {"motion", *by_hand}
        assert all(0.0 <= one.decides <= 1.0 for one in document.experiments)


@pytest.mark.parametrize(
    ("verdict", "confirmed", "outcome"),
    [
        ("adequate", True, "good"),
        ("adequate", None, "not_verified"),
        ("adequate", False, "not_verified"),
        ("explained", True, "repair"),
        ("explained", None, "not_verified"),
        ("ambiguous", False, "ambiguous"),
        ("ambiguous", None, "ambiguous"),
        ("partly_explained", True, "unexplained"),
        ("unexplained", False, "unexplained"),
    ],
)
def test_what_the_owner_has_to_do(verdict: str, confirmed: bool | None, outcome: str) -> None:
    decision = Decision(verdict, confirmed)  # type: ignore[arg-type]
    assert decision.outcome == outcome


def test_second_ripple_of_the_same_joint_is_found() -> None:
    """The first ripple is found while the second disturbs it; both are settled beside each other."""
    ripples = [
        {"kind": "gear_cyclic", "joint": 2, "amplitude_deg": a, "per_rev": n}
        for a, n in ((0.01, 12), (0.004, 17))
    ]
    machine = Drawn(*ripples, seed=7)
    found = weighed(ROBOT, machine.sequence(), machine.fresh())
    assert (found.verdict, found.confirmed) == ("explained", True)
    values = [q for finding in found.found.findings for q in finding.parameters]
    per_rev = sorted(q.value for q in values if q.name == "per_rev")
    assert per_rev == pytest.approx([12.0, 17.0], abs=0.3)
