"""One robot over REST: its file, its memory, forgetting it."""

from __future__ import annotations

from station.records import MemoryUse
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
    used = {"used": True, "p_value": 0.4, "text": "as found", "from_calibration": 1, "age_days": 2.5}
    store = service.runtime.store
    first, second = finish(store), finish(store, memory=MemoryUse.model_validate(used))
    answers = [service.client.get(f"/api/v1/calibrations/{run}").json()["memory"] for run in (first, second)]
    assert answers == [None, used]
