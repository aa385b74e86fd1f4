"""What crossed the wires in a run, over REST."""

from __future__ import annotations

import re
import zlib
from pathlib import Path

from pydantic import JsonValue

import station.store
from station.records import WireHeader
from tests.web.conftest import Service

JOINTS: list[JsonValue] = [{"unit": 1, "zero_at_deg": 0.0}, {"unit": 2, "zero_at_deg": 180.0}]
HEADER = WireHeader(
    scale={"protocol": "heidenhain-nd", "url": "serial:///dev/ttyUSB0"},
    servo={"profile": "leadshine-el7", "url": "modbus+tcp://10.0.0.7:502", "joint": JOINTS},
    limits={},
    speed=1.0,
)
ASK_POSITION = "0001 0000 0006 02 03 602c 0002"
POSITION = "0001 0000 0007 02 03 04 fffffff6"  # -10 pulses
STOP = "0002 0000 0006 01 06 6002 0040"
LINES = (
    f"0 2> {ASK_POSITION}", f"41 2< {POSITION}", f"10 2>* {STOP}", "5 1> 11", "100 1> 02", "300 1< 2b313233",
    "5 1! 67 6f 6e 65", f"9 2> {ASK_POSITION}",
)  # fmt: skip


def keep(service: Service, run: int) -> None:
    lines = [" ".join((*line.split(" ", 2)[:2], line.split(" ", 2)[2].replace(" ", ""))) for line in LINES]
    service.runtime.store.add_wire(run, zlib.compress("\n".join([HEADER.model_dump_json(), *lines]).encode()))


def test_each_request_stands_with_its_answer_and_its_time(service: Service) -> None:
    run = service.complete()
    keep(service, run)
    first, stop, resumed, scale, broken, last = service.client.get(f"/api/v1/calibrations/{run}/wire").json()[
        "items"
    ]
    assert (first["device"], first["action"], first["subject"]) == ("drive 2", "read", "position, pulses")
    assert (first["took_ms"], first["angle_deg"], first["beside"]) == (4.1, 179.982, False)
    assert (stop["device"], stop["action"], stop["took_ms"], stop["beside"]) == (
        "drive 1",
        "write",
        None,
        True,
    )
    assert (resumed["action"], resumed["took_ms"]) == ("other", None), "nothing answers to XON"
    assert (scale["device"], scale["subject"], scale["took_ms"]) == ("scale", "what is the value?", 30.0)
    assert (broken["action"], broken["answer"]) == ("broken", "gone")
    assert last["answer"] == "" and last["took_ms"] is None, "nothing came"


def test_pages_follow_each_other(service: Service) -> None:
    run = service.complete()
    keep(service, run)
    url = f"/api/v1/calibrations/{run}/wire"
    page = service.client.get(url, params={"limit": 3}).json()
    assert page["next"] == 3
    rest = service.client.get(url, params={"limit": 3, "cursor": page["next"]}).json()
    assert (len(page["items"]), len(rest["items"]), rest["next"]) == (3, 3, None)


def test_a_run_without_a_log_says_so(service: Service) -> None:
    answer = service.client.get("/api/v1/calibrations/1/wire")
    assert (answer.status_code, answer.json()["detail"]) == (404, "No wire log of run 1 is kept here.")


def newest_step() -> str:
    """The last step of the file of migrations."""
    source = Path(station.store.__file__).with_name("migrations.py").read_text(encoding="utf-8")
    steps: list[str] = re.findall(r"@migrations\(\)\ndef (\w+)", source)
    return steps[-1]


def test_versions_name_program_tables_and_libraries(service: Service) -> None:
    found = service.client.get("/api/v1/versions").json()
    assert found["program"] and found["python"] and found["schema_step"] == newest_step()
    assert found["libraries"]["numpy"]
