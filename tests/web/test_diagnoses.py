"""The diagnosis of a run over HTTP: document, findings, report."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest

from station.records import State
from tests.station.asking import asked
from tests.station.run_kinds.test_diagnose import BACKLASH, ROBOT, machine, run
from tests.station.run_kinds.test_separate import DRIFT
from tests.web.conftest import Service

LIST = "/api/v1/calibrations"


def diagnosed_run(service: Service) -> int:
    """A run on a robot with backlash as it is stored."""
    store = service.runtime.store
    readings, result = run(machine(BACKLASH))
    number = store.create(asked("R1", "diagnostic"), ROBOT)
    store.add_readings(number, readings)
    assert store.finish(number, State.SUCCEEDED, result) is State.SUCCEEDED
    return number


def test_the_document_is_answered_whole_and_the_findings_with_the_run(service: Service) -> None:
    number = diagnosed_run(service)
    document = service.client.get(f"{LIST}/{number}/diagnosis").json()
    assert (document["schema"], document["verdict"], document["confirmed"]) == (
        "station.diagnosis/2",
        "explained",
        True,
    )
    calibration = service.client.get(f"{LIST}/{number}").json()
    assert [finding["effect"] for finding in calibration["findings"]] == ["backlash"]
    (moved,) = service.client.get("/api/v1/trend").json()["effects"]
    assert (moved["effect"], moved["joint"], moved["lines"]["at"]) == ("backlash", 1, [calibration["id"]])
    assert moved["values"] == [calibration["findings"][0]["parameters"][0]["value"]]
    assert calibration["after"]["fresh_reading_rms_mm"] < calibration["before"]["fresh_reading_rms_mm"]
    assert calibration["application"] is None
    assert "findings" not in service.client.get(LIST).json()["items"][0]


def test_the_report_is_one_page_that_loads_nothing(service: Service) -> None:
    number = diagnosed_run(service)
    answer = service.client.get(f"{LIST}/{number}/report.html")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/html")
    assert "default-src 'none'" in answer.headers["content-security-policy"]
    uid = service.client.get(f"{LIST}/{number}").json()["uid"]
    assert f"Diagnosis of run {number}, uid {uid}, robot R1" in answer.text
    known = {"If-None-Match": answer.headers["etag"]}
    assert service.client.get(f"{LIST}/{number}/report.html", headers=known).status_code == 304
    assert service.client.get(f"{LIST}/{number}/diagnosis").json()["sentence"] in answer.text
    assert "<script" not in answer.text
    german = service.client.get(f"{LIST}/{number}/report.html?language=de").text
    assert '<html lang="de">' in german
    assert f"Diagnose von Lauf {number}, Kennung {uid}, Roboter R1" in german
    assert "Getriebespiel von Gelenk 1" in german and "backlash" not in german
    assert service.client.get(f"{LIST}/{number}/report.html?language=fr").status_code == 422


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


def test_the_motion_that_separates_is_planned_for_whoever_asks(service: Service) -> None:
    store = service.runtime.store
    readings, result = run(machine(DRIFT))
    number = store.add_run(asked("R1", "diagnostic"), ROBOT, readings, result)
    plan = service.client.get(f"{LIST}/{number}/separating").json()
    assert "unnamed error over time" in plan["apart"]
    assert (len(plan["stops"]) >= 40, plan["refused"]) == (True, None)
    assert plan["duration_s"] > 0
    assert set(plan["stops"][0]) == {"position", "x_mm", "y_mm"}


def test_why_nothing_is_separated(service: Service) -> None:
    number = diagnosed_run(service)
    plan = service.client.get(f"{LIST}/{number}/separating").json()
    assert (plan["apart"], plan["stops"], plan["duration_s"]) == ([], [], None)
    answer = service.client.post(f"{LIST}/{number}/separate", json={"operator": "ada"})
    assert (answer.status_code, answer.json()["detail"]) == (409, plan["refused"])
    assert "No further motion" in plan["refused"]
    plain = service.complete()
    answer = service.client.post(f"{LIST}/{plain}/separate", json={"operator": "ada"})
    assert (answer.status_code, answer.json()["detail"]) == (404, f"Run {plain} has no diagnosis.")
    assert service.client.get(f"{LIST}/{plain}/separating").status_code == 404


def test_the_separating_run_goes_on_from_the_readings_and_the_clock_of_the_run(service: Service) -> None:
    store = service.runtime.store
    readings, result = run(machine(DRIFT))
    number = store.add_run(asked("FB-1", "diagnostic"), ROBOT, readings, result)
    service.rig.axes[0].stuck = True
    answer = service.client.post(f"{LIST}/{number}/separate", json={"operator": "ada"})
    assert answer.status_code == 202
    begun = answer.json()
    assert (begun["plan"], begun["of"]) == ("separating", number)
    service.wait_for("axis 1 move_to")
    assert store.readings(begun["id"]) == store.readings(number)[:120]
    under_way = service.client.get("/api/v1/station").json()["run"]
    assert under_way["step"] == 120
    assert under_way["steps"] == 120 + len(under_way["stops"]) >= 160
    service.client.post(f"{LIST}/{begun['id']}/abort")
    assert service.runtime.orchestrator.wait(begun["id"], 10.0) is State.ABORTED
