"""Events of two stations through a real broker into Parquet files, over a kill of the collector."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from pathlib import Path

import duckdb
from pydantic import JsonValue

from station.outbox.mqtt import Mqtt
from station.records import Event, uid7
from station.settings import MqttSettings
from tests.docs.pages import ROOT
from tests.station.outbox.test_receivers import broker, free_port

LIMIT_S = 20.0
COLLECTOR = ROOT / "deploy/fleet/collector.py"
QUESTION = (ROOT / "deploy/fleet/moved.sql").read_text()
FIRST = datetime(2026, 10, 5, tzinfo=UTC)


def ended(n: int, serial: str, zero1_deg: float) -> Event:
    data: dict[str, JsonValue] = {
        "uid": uid7(),
        "id": n,
        "robot_serial": serial,
        "kind": "calibrate",
        "outcome": "good",
        "zero_offsets": [{"joint": 1, "value_deg": zero1_deg}, {"joint": 2, "value_deg": 0.0}],
    }
    return Event(n=n, uid=uid7(), type="run.ended", at=FIRST + timedelta(days=n), data=data)


@contextmanager
def collecting(port: int, folder: Path, every_s: float) -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen(
        [sys.executable, str(COLLECTOR), f"mqtt://127.0.0.1:{port}", str(folder)],
        env={**os.environ, "WRITE_EVERY_S": str(every_s)},
        stdout=subprocess.DEVNULL,
    )
    try:
        yield process
    finally:
        process.terminate()
        process.wait()


def collected(folder: Path) -> int:
    files = f"{folder}/*/*.parquet"
    if not list(folder.glob("*/*.parquet")):
        return 0
    (count,) = duckdb.connect().execute(f"select count(distinct event_uid) from '{files}'").fetchall()[0]
    return int(count)


def until(folder: Path, count: int) -> None:
    deadline = time.monotonic() + LIMIT_S
    while collected(folder) < count:
        assert time.monotonic() < deadline, collected(folder)
        time.sleep(0.05)


def test_nothing_is_lost_when_the_collector_is_killed(tmp_path: Path) -> None:
    port, folder = free_port(), tmp_path / "collected"
    with broker(port, tmp_path):
        stations = {
            name: Mqtt(MqttSettings(url=f"mqtt://127.0.0.1:{port}", topic=f"stations/{name}"))
            for name in ("north", "south")
        }
        with collecting(port, folder, 0.1):
            # the session begins with the first connection; what is told before is for nobody
            number = 0
            while not collected(folder):
                number += 1
                stations["north"].deliver(ended(number, "FB-1", 0.1))
                time.sleep(0.2)
        before = collected(folder)
        with collecting(port, folder, 60.0) as process:
            stations["south"].deliver(ended(1, "FB-2", -0.4))
            time.sleep(0.5)
            process.kill()
        stations["south"].deliver(ended(2, "FB-2", -0.1))
        with collecting(port, folder, 0.1):
            until(folder, before + 2)
        for station in stations.values():
            station.close()
    moved = duckdb.connect().execute(QUESTION.replace("/collected", str(folder))).fetchall()
    assert [(station, robot) for station, robot, *_ in moved] == [("south", "FB-2")]
    assert abs(moved[0][3] - 0.3) < 1e-9
