"""Measurement files imported over HTTP: whole with their diagnosis, or refused with nothing left behind."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from station.records import parse_readings, readings_to_csv
from station.run_kinds import import_file as dataset
from station.studies.arms.physics import UR_LIKE, random_arm, random_poses
from tests.station.run_kinds.test_diagnose import BACKLASH, machine, run
from tests.web.conftest import Service
from tests.web.test_problems import problem_of

DATASETS = "/api/v1/datasets"
LIST = "/api/v1/calibrations"


def files_of(*effects: dict[str, Any]) -> tuple[bytes, bytes]:
    """A sequence and its fresh readings as measurement files."""
    readings, _ = run(machine(*effects))
    sequence, fresh = (readings_to_csv(r for r in readings if r.sequence == n).encode() for n in (1, 2))
    return sequence, fresh


@pytest.fixture(scope="module")
def worn() -> tuple[bytes, bytes]:
    return files_of(BACKLASH)


def send(
    service: Service, sequence: bytes, fresh: bytes | None = None, key: str | None = None, **data: str
) -> Any:
    files = {"file": ("walk.csv", sequence, "text/csv")} | (
        {"fresh": ("fresh.csv", fresh, "text/csv")} if fresh is not None else {}
    )
    headers = {"Idempotency-Key": key} if key else {}
    return service.client.post(DATASETS, files=files, data=data, headers=headers)


def test_a_file_with_fresh_readings_becomes_a_run_with_its_cause_confirmed(
    service: Service, worn: tuple[bytes, bytes]
) -> None:
    answer = send(service, *worn, robot_serial="FB-9", operator="ada", work_order="W1")
    assert answer.status_code == 201
    summary = answer.json()
    assert answer.headers["location"] == f"{LIST}/{summary['id']}"
    assert summary["reason"].startswith("Backlash of joint 1 explained 9")
    kept = {k: summary[k] for k in ("robot_serial", "plan", "operator", "work_order", "state", "verdict")}
    assert kept == {
        "robot_serial": "FB-9",
        "plan": "dataset",
        "operator": "ada",
        "work_order": "W1",
        "state": "succeeded",
        "verdict": "fail",
    }
    calibration = service.client.get(answer.headers["location"]).json()
    assert [finding["effect"] for finding in calibration["findings"]] == ["backlash"]
    assert calibration["metadata"]["file"]["name"] == "walk.csv"
    assert calibration["step"] == calibration["steps"] == 160
    assert calibration["application"] is None
    document = service.client.get(f"{answer.headers['location']}/diagnosis").json()
    assert (document["confirmed"], document["data"]["file"]) == (True, "walk.csv")
    report = service.client.get(f"{answer.headers['location']}/report.html")
    assert document["sentence"] in report.text


def test_the_readings_come_back_as_they_were_sent(service: Service, worn: tuple[bytes, bytes]) -> None:
    sequence, fresh = worn
    where = send(service, sequence, fresh).headers["location"]
    learned = parse_readings(sequence)
    later = parse_readings(fresh, sequence=2, after=learned[-1].reading)
    number = int(where.rpartition("/")[2])
    assert service.runtime.store.readings(number) == [*learned, *later]
    assert service.client.get(f"{where}/readings.csv").content.startswith(sequence)


def test_a_plain_csv_body_is_diagnosed_but_without_fresh_readings_it_is_no_pass(
    service: Service, worn: tuple[bytes, bytes]
) -> None:
    headers = {"Content-Type": "text/csv; charset=utf-8"}
    answer = service.client.post(f"{DATASETS}?robot_serial=FB-2", content=worn[0], headers=headers)
    assert answer.status_code == 201
    summary = answer.json()
    assert (summary["robot_serial"], summary["verdict"]) == ("FB-2", "fail")
    assert summary["reason"].endswith("No fresh readings confirm it.")


def test_readings_that_miss_nothing_pass_only_when_fresh_ones_agree(service: Service) -> None:
    sequence, fresh = files_of()
    assert send(service, sequence, fresh).json()["verdict"] == "pass"
    assert send(service, sequence).json()["verdict"] == "fail"


def test_the_robot_file_that_is_kept_here_counts(service: Service, worn: tuple[bytes, bytes]) -> None:
    store = service.runtime.store
    other = store.robot_or_nominal("FB-3")
    store.save_robot(replace(other, d=(0.0, -51.5)))
    number = send(service, *worn, robot_serial="FB-3").json()["id"]
    assert store.robot_of(number).d == (0.0, -51.5)


def test_a_mistake_in_the_robot_file_is_refused_by_name(service: Service, worn: tuple[bytes, bytes]) -> None:
    store = service.runtime.store
    store.save_robot(replace(store.robot_or_nominal("FB-3"), d=(0.0, -60.0)))
    assert "d" in problem_of(send(service, *worn, robot_serial="FB-3"), 422)["detail"]
    assert service.client.get(LIST).json()["items"] == []


def test_it_needs_no_rig(service: Service, worn: tuple[bytes, bytes]) -> None:
    running = service.hold()
    assert send(service, *worn).status_code == 201
    station = service.client.get("/api/v1/station").json()
    assert station["run"]["id"] == running
    service.client.post(f"{LIST}/{running}/abort")


def test_what_was_imported_is_never_shown_as_the_rigs_last_run(
    service: Service, worn: tuple[bytes, bytes]
) -> None:
    own = service.complete()
    imported = send(service, *worn).json()["id"]
    assert service.client.get("/api/v1/station").json()["last"]["id"] == own
    last = service.runtime.store.last_on_rig()
    assert last is not None and last.id == own < imported


def test_its_offsets_are_never_written_to_the_drives(service: Service, worn: tuple[bytes, bytes]) -> None:
    where = send(service, *worn).headers["location"]
    document = problem_of(service.client.post(f"{where}/apply", json={"operator": "ada"}), 409)
    assert "of kind import" in document["detail"]


def test_the_same_key_answers_the_same_run(service: Service, worn: tuple[bytes, bytes]) -> None:
    first = send(service, *worn, key="k1")
    again = send(service, *worn, key="k1")
    assert first.json() == again.json()
    assert first.headers["location"] == again.headers["location"]
    problem_of(send(service, worn[0], key="k1"), 409)
    assert len(service.client.get(LIST).json()["items"]) == 1


HEADER = b"reading,t_s,theta1_deg,theta2_deg,scale_mm\n"
MALFORMED = {
    "empty": (b"", "walk.csv is empty"),
    "no CSV at all": (b"\x89PNG\r\n\x1a\n\x00\x00", "not a text file"),
    "column missing": (b"reading,t_s\n1,2\n", "column theta1_deg, theta2_deg, scale_mm is missing"),
    "not finite": (HEADER + b"1,0,0,180,nan\n", "row 2, column scale_mm"),
    "beyond all measure": (HEADER + b"1,0,0,180,1e300\n", "row 2, column scale_mm"),
    "twice": (HEADER + b"1,0,0,180,1\n1,1,0,180,1\n", "row 3, column reading"),
    "wrong unit": (
        HEADER + b"".join(b"%d,%d,%d,0,%d\n" % (k, k, 90 - k, 3 * k) for k in range(40)),
        "Check unit",
    ),
    "too few": (
        HEADER + b"".join(b"%d,%d,%d,180,%d\n" % (k, k, k, 3 * k) for k in range(7)),
        "Not enough data",
    ),
}


@pytest.mark.parametrize("name", list(MALFORMED))
def test_a_malformed_file_is_refused_and_nothing_is_stored(service: Service, name: str) -> None:
    content, said = MALFORMED[name]
    document = problem_of(send(service, content, robot_serial="FB-4"), 422)
    assert said in document["detail"]
    nothing_is_stored(service)


def nothing_is_stored(service: Service) -> None:
    assert service.client.get(LIST).json()["items"] == []
    assert service.runtime.store.robots() == []


def test_malformed_fresh_readings_are_refused_with_their_file(
    service: Service, worn: tuple[bytes, bytes]
) -> None:
    document = problem_of(send(service, worn[0], b"reading\n1\n"), 422)
    assert document["detail"].startswith("fresh.csv: row 1")
    nothing_is_stored(service)


def test_a_failure_while_storing_leaves_nothing_half_stored(
    service: Service, worn: tuple[bytes, bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise RuntimeError("disk full")

    monkeypatch.setattr("station.store.results.pack_document", broken)
    problem_of(send(service, *worn), 500)
    nothing_is_stored(service)


def test_what_is_too_large_is_refused(
    service: Service, worn: tuple[bytes, bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dataset, "MOST_READINGS", 159)
    assert "160 readings" in problem_of(send(service, *worn), 422)["detail"]
    small = service.runtime.settings.service.model_copy(update={"body_mb": 0.001})
    settings = service.runtime.settings.model_copy(update={"service": small})
    monkeypatch.setattr(service.runtime, "settings", settings)
    assert "larger than 1000 bytes" in problem_of(send(service, *worn), 413)["detail"]
    nothing_is_stored(service)


def test_another_content_type_is_refused(service: Service) -> None:
    headers = {"Content-Type": "application/json"}
    document = problem_of(service.client.post(DATASETS, content=b"{}", headers=headers), 415)
    assert "text/csv" in document["detail"]
    nothing_is_stored(service)


FILE_PART = b'--x\r\nContent-Disposition: form-data; name="file"; filename="a.csv"\r\n\r\nreading\r\n'
TEXT_PART = b'--x\r\nContent-Disposition: form-data; name="file"\r\n\r\nreading\r\n'
FORMS = {
    "no boundary": ("", FILE_PART, 400, "boundary"),
    "another boundary": ("; boundary=y", FILE_PART + b"--x--\r\n", 400, "cut off"),
    "cut off": ("; boundary=x", FILE_PART, 400, "cut off"),
    "empty": ("; boundary=x", b"--x--\r\n", 422, "no file `file`"),
    "text in place of a file": ("; boundary=x", TEXT_PART + b"--x--\r\n", 422, "`file` is out of place"),
    "a file twice": ("; boundary=x", 2 * FILE_PART + b"--x--\r\n", 422, "`file` is out of place"),
}


@pytest.mark.parametrize("name", list(FORMS))
def test_a_form_that_is_none_is_refused(service: Service, name: str) -> None:
    boundary, body, status, said = FORMS[name]
    headers = {"Content-Type": f"multipart/form-data{boundary}"}
    answer = service.client.post(DATASETS, content=body, headers=headers)
    assert said in problem_of(answer, status)["detail"]
    nothing_is_stored(service)


def test_a_file_that_nobody_asked_for_is_refused(service: Service, worn: tuple[bytes, bytes]) -> None:
    files = {"file": ("a.csv", worn[0]), "more": ("b.csv", worn[1])}
    answer = service.client.post(DATASETS, files=files)
    assert "`more` is out of place" in problem_of(answer, 422)["detail"]
    nothing_is_stored(service)


def test_only_the_name_of_a_file_is_kept(service: Service, worn: tuple[bytes, bytes]) -> None:
    files = {"file": ("C:\\plant\\walk.csv", worn[0]), "fresh": ("../../etc/fresh.csv", worn[1])}
    where = service.client.post(DATASETS, files=files).headers["location"]
    metadata = service.client.get(where).json()["metadata"]
    assert (metadata["file"]["name"], metadata["fresh"]["name"]) == ("walk.csv", "fresh.csv")


@pytest.mark.parametrize(
    ("field", "value"), [("robot_serial", "no such; serial"), ("operator", ""), ("plan", "paper")]
)
def test_a_field_at_fault_is_named(
    service: Service, worn: tuple[bytes, bytes], field: str, value: str
) -> None:
    data: dict[str, Any] = {field: value}
    assert problem_of(send(service, *worn, **data), 422)["field"] == field
    answer = service.client.post(
        DATASETS, params={field: value}, content=b"", headers={"Content-Type": "text/csv"}
    )
    assert problem_of(answer, 422)["field"] == field
    nothing_is_stored(service)


def test_ids_that_are_no_rising_numbers_are_replaced_by_the_row() -> None:
    rows = b"a,0,0,180,1\nb,1,1,181,2\nc,2,2,182,3\nd,3,3,183,4\ne,4,4,184,5\n"
    assert [r.reading for r in parse_readings(HEADER + rows, after=7)] == [8, 9, 10, 11, 12]
    assert [r.position for r in parse_readings(HEADER + rows)][:2] == ["row 2", "row 3"]


def test_the_log_of_an_arm_is_imported_once_its_robot_file_is_kept(service: Service) -> None:
    arm = random_arm(UR_LIKE, 31)
    m = arm.log(random_poses(6, 40, 31), 31)
    assert m.tracker is not None
    header = [f"theta{i}_deg" for i in range(1, 7)] + [f"tracker_{a}_mm" for a in "xyz"]
    rows = np.column_stack([np.degrees(m.theta), m.tracker]).tolist()
    content = "\n".join(",".join(map(str, row)) for row in (header, *rows)).encode()
    unknown = send(service, content, robot_serial="A6", operator="ada")
    assert unknown.status_code == 422
    kept = service.client.put("/api/v1/robots/A6", json=arm.robot.to_json())
    assert (kept.status_code, kept.json()["file"]["robot"]["model"]) == (200, "serial-dh")
    answer = send(service, content, robot_serial="A6", operator="ada")
    assert answer.status_code == 201
    address = answer.headers["location"]
    run = service.client.get(address).json()
    assert (run["machine"], len(run["zero_offsets"]), run["step"]) == ("serial-dh", 6, 40)
    assert len(service.client.get(f"{address}/residuals").json()["items"]) == 40
    assert "<svg" in service.client.get(f"{address}/report.html").text
    assert service.client.get(f"{address}/readings.csv").content == content
    for what in ("readings", "error-map", "certificate.json"):
        problem_of(service.client.get(f"{address}/{what}"), 409)
    assert service.client.get(f"{address}/separating").json()["refused"]
    # and the rig does not start a run of it
    assert service.start(robot_serial="A6").status_code == 409


MAP = """
decimal = ","
[columns]
theta_deg = {columns = ["q1", "q2", "q3", "q4", "q5", "q6"], unit = "rad"}
tracker_mm = {columns = ["x", "y", "z"], unit = "m"}
"""


def test_the_log_of_an_arm_from_other_software_is_imported_with_a_column_map(service: Service) -> None:
    arm = random_arm(UR_LIKE, 32)
    m = arm.log(random_poses(6, 60, 32), 32)
    assert m.tracker is not None
    rows = np.column_stack([m.theta, m.tracker / 1000.0]).tolist()
    lines = [
        "q1;q2;q3;q4;q5;q6;x;y;z",
        *(";".join(f"{x:.9f}" for x in row).replace(".", ",") for row in rows),
    ]
    content = "\n".join(lines).encode()
    service.client.put("/api/v1/robots/A6", json=arm.robot.to_json())
    who: dict[str, Any] = {"robot_serial": "A6", "operator": "ada"}
    assert "station columns" in problem_of(send(service, content, **who), 422)["detail"]
    answer = send(service, content, columns=MAP, hold_out="true", **who)
    assert answer.status_code == 201
    diagnosis = service.client.get(f"{answer.headers['location']}/diagnosis").json()
    assert diagnosis["verdict"] == "adequate"
    assert diagnosis["confirmed"] is True
    assert service.client.get(f"{answer.headers['location']}/readings.csv").content == content
    wrong = send(service, content, columns="[columns]\ntheta_deg = 1.5", **who)
    assert "Column map" in problem_of(wrong, 422)["detail"]
