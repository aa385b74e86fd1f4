"""One robot over REST: its file, its memory, forgetting it."""

from __future__ import annotations

import pytest

from station.five_bar import Robot
from station.records import MemoryUse, sections_to_toml
from tests.station.run_kinds.test_memory import LASTING, finish
from tests.web.conftest import Service

ROBOT = "/api/v1/robots/R1"


def test_a_robot_tells_what_its_next_run_will_know(service: Service) -> None:
    run = finish(service.runtime.store)
    robot = service.client.get(ROBOT).json()
    assert robot["serial"] == robot["file"]["robot"]["serial"] == "R1"
    assert robot["memory"]["from_calibration"] == run
    assert [q["value"] for q in robot["memory"]["parameters"]] == list(LASTING.mean)


def test_forgetting_may_be_asked_twice(service: Service) -> None:
    finish(service.runtime.store)
    for _ in range(2):
        answer = service.client.delete(f"{ROBOT}/memory", headers={"X-Operator": "ada"})
        assert (answer.status_code, answer.content) == (204, b"")
    assert service.client.get(ROBOT).json()["memory"] is None


def test_a_robot_that_is_not_known_is_not_found(service: Service) -> None:
    assert service.client.get("/api/v1/robots/R9").status_code == 404
    assert service.client.delete("/api/v1/robots/R9/memory").status_code == 404


def test_a_result_says_whether_memory_took_part(service: Service) -> None:
    used = {
        "used": True,
        "p_value": 0.4,
        "text": "as found",
        "said": None,
        "from_calibration": 1,
        "age_days": 2.5,
    }
    store = service.runtime.store
    first, second = finish(store), finish(store, memory=MemoryUse.model_validate(used))
    answers = [service.client.get(f"/api/v1/calibrations/{run}").json()["memory"] for run in (first, second)]
    assert answers == [None, used]


def test_the_robots_are_listed_by_serial_page_by_page(service: Service) -> None:
    empty = service.client.get("/api/v1/robots")
    assert (empty.status_code, empty.json()) == (200, {"items": [], "next": None})
    for serial in ("R3", "R1", "R2"):
        service.runtime.store.save_robot(Robot.default(serial))
    changed = {**Robot.default("R1").to_json(), "workspace": CHANGED["workspace"]}
    service.client.put("/api/v1/robots/R1", json=changed)
    first = service.client.get("/api/v1/robots", params={"limit": 2}).json()
    assert [robot["serial"] for robot in first["items"]] == ["R1", "R2"]
    assert first["items"][0]["file"]["workspace"] == changed["workspace"]
    rest = service.client.get("/api/v1/robots", params={"limit": 2, "cursor": first["next"]}).json()
    assert ([robot["serial"] for robot in rest["items"]], rest["next"]) == (["R3"], None)
    assert service.client.get("/api/v1/robots", params={"limit": 3}).json()["next"] is None


FILE = Robot.default("FB-9")
CHANGED = {**FILE.to_json(), "workspace": {"x": [-200.0, 200.0], "y": [-780.0, -640.0]}}


def test_a_robot_file_is_put_as_toml_or_json(service: Service) -> None:
    toml = sections_to_toml(FILE.to_json())
    put = service.client.put(
        "/api/v1/robots/FB-9", content=toml, headers={"Content-Type": "application/toml"}
    )
    assert put.status_code == 200, put.text
    changed = service.client.put("/api/v1/robots/FB-9", json=CHANGED)
    assert changed.status_code == 200, changed.text
    assert service.runtime.store.robot("FB-9").workspace_x == (-200.0, 200.0)
    (entry, first) = service.client.get("/api/v1/audit").json()["items"]
    assert entry["action"] == "robot.changed"
    assert entry["before"]["workspace"]["x"] == list(FILE.workspace_x)
    assert entry["after"]["workspace"]["x"] == [-200.0, 200.0]
    assert first["before"] is None


@pytest.mark.parametrize(
    ("kind", "content", "status"),
    [
        ("application/toml", b"[robot", 422),
        ("application/toml", b"[robot]\nserial = 'FB-9'\ne = nan\nL = 1.0\nl = 1.0", 422),
        ("application/toml", b"\xff", 422),
        ("application/json", b"[]", 422),
        ("application/json", b'{"robot": {"serial": "FB-1", "e": 250.0, "L": 375.0, "l": 385.0}}', 422),
        ("application/json", b'{"robot": {"serial": "FB-9", "e": 1e999}}', 422),
        ("application/json", b'{"robot": {"serial": "\\ud800"}}', 422),
        ("application/json", b"[" * 100_000, 422),
        ("text/plain", b"", 415),
    ],
)
def test_a_robot_file_that_is_none_leaves_nothing(
    service: Service, kind: str, content: bytes, status: int
) -> None:
    answer = service.client.put("/api/v1/robots/FB-9", content=content, headers={"Content-Type": kind})
    assert answer.status_code == status, answer.text
    assert service.client.get("/api/v1/robots/FB-9").status_code == 404
