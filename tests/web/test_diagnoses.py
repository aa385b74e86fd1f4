"""The diagnosis of a run over HTTP: document, findings, report."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest

from station.records import CalibrationRequest, State
from tests.station.test_diagnosing import BACKLASH, ROBOT, machine, run
from tests.web.conftest import Service

LIST = "/api/v1/calibrations"


def diagnosed_run(service: Service) -> int:
    """A run on a robot with backlash as it is stored."""
    store = service.runtime.store
    readings, result = run(machine(BACKLASH))
    number = store.create(CalibrationRequest("R1", "diagnostic", "ada"), ROBOT)
    store.add_readings(number, readings)
    assert store.finish(number, State.SUCCEEDED, result) is State.SUCCEEDED
    return number


def test_the_document_is_answered_whole_and_the_findings_with_the_run(service: Service) -> None:
    number = diagnosed_run(service)
    document = service.client.get(f"{LIST}/{number}/diagnosis").json()
    assert (document["schema"], document["verdict"], document["confirmed"]) == (
        "station.diagnosis/1",
        "explained",
        True,
    )
    calibration = service.client.get(f"{LIST}/{number}").json()
    assert [finding["effect"] for finding in calibration["findings"]] == ["backlash"]
    assert calibration["after"]["fresh_reading_rms_mm"] < calibration["before"]["fresh_reading_rms_mm"]
    assert calibration["application"] is None
    assert "findings" not in service.client.get(LIST).json()["items"][0]


def test_the_report_is_one_page_that_loads_nothing(service: Service) -> None:
    number = diagnosed_run(service)
    answer = service.client.get(f"{LIST}/{number}/report.html")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/html")
    assert "default-src 'none'" in answer.headers["content-security-policy"]
    assert f"Diagnosis of run {number}, robot R1" in answer.text
    assert service.client.get(f"{LIST}/{number}/diagnosis").json()["sentence"] in answer.text
    assert "<script" not in answer.text


def test_residuals_are_told_with_what_the_effects_account_for(service: Service) -> None:
    number = diagnosed_run(service)
    answer = service.client.get(f"{LIST}/{number}/residuals").json()
    document = service.client.get(f"{LIST}/{number}/diagnosis").json()
    assert answer["effects"] == ["backlash of joint 1"]
    rows = answer["items"]
    readings = service.client.get(f"{LIST}/{number}/readings").json()["items"][:120]
    for key in ("reading", "position", "approach1", "approach2"):
        assert [row[key] for row in rows] == [reading[key] for reading in readings]
    for key, stage in (("before_mm", "before"), ("after_mm", "after")):
        assert rms(row[key] for row in rows) == pytest.approx(document[stage]["fit_rms_mm"], rel=1e-6)
    for row in rows:
        assert row["before_mm"] - sum(row["by_effect_mm"]) == pytest.approx(row["after_mm"], abs=1e-12)
        assert abs(row["after_mm"]) < row["limit_mm"]
    # play moves the arm one way or the other by approach: so does what it accounts for
    above, below = (
        np.mean([row["by_effect_mm"][0] for row in rows if row["approach1"] == side]) for side in (-1, 1)
    )
    assert abs(above - below) > 0.01


def rms(values: Iterable[float]) -> float:
    return float(np.sqrt(np.mean(np.square(list(values)))))


def test_a_run_without_a_diagnosis_says_so(service: Service) -> None:
    number = service.complete()
    for path in ("diagnosis", "report.html", "residuals"):
        answer = service.client.get(f"{LIST}/{number}/{path}")
        assert (answer.status_code, answer.json()["detail"]) == (404, f"Run {number} has no diagnosis.")
        assert service.client.get(f"{LIST}/99/{path}").status_code == 404
