"""References and wished accuracy over REST: taken, recorded, refused in words."""

from __future__ import annotations

from typing import Any

import pytest

from tests.web.conftest import Service

JOINT = {"kind": "joint_angle", "joint": 1, "at_deg": 0.0, "reads_deg": 0.012, "sd_deg": 0.005}
MOUNTING = {"kind": "drm_x", "value_mm": 1.02, "sd_mm": 0.02}


def test_what_was_asked_for_is_on_record(service: Service) -> None:
    run = service.complete(references=[JOINT, MOUNTING], accuracy_mm=0.2)
    asked = [event for event in service.runtime.store.events(run) if event.kind == "asked"]
    assert [event.data for event in asked] == [{"references": [JOINT, MOUNTING], "accuracy_mm": 0.2}]


def test_they_belong_to_the_request_of_a_key(service: Service) -> None:
    first = service.start(key="k1", references=[JOINT])
    service.runtime.orchestrator.wait(first.json()["id"], 10.0)
    assert service.start(key="k1", references=[JOINT]).json()["id"] == first.json()["id"]
    assert service.start(key="k1", references=[MOUNTING]).status_code == 409


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"references": [{**JOINT, "joint": 3}]}, "references.0.joint_angle.joint"),
        ({"references": [{**JOINT, "sd_deg": 0.0}]}, "references.0.joint_angle.sd_deg"),
        ({"references": [{"kind": "level"}]}, "references.0"),
        ({"accuracy_mm": -1.0}, "accuracy_mm"),
        ({"until_mm": 0.0}, "until_mm"),
    ],
)
def test_what_makes_no_sense_is_refused_by_field(
    service: Service, changes: dict[str, Any], field: str
) -> None:
    answer = service.start(**changes)
    assert answer.status_code == 422
    assert answer.json()["field"] == field


def test_what_cannot_be_is_refused_in_words(service: Service) -> None:
    answer = service.start(references=[{**JOINT, "reads_deg": 30.0}])
    assert answer.status_code == 422
    assert "from what the robot file expects" in answer.json()["detail"]
