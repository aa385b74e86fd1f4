"""The worked job of `connect-a-mes.md`, in Python and with curl, against a real station that is killed."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest

from fivebar_client import CalibrationBody, CalibrationSummary, Station
from station.people import new_secret, secret_hash
from station.records import Actor
from station.store import Store
from tests.docs.pages import FENCE, ROOT
from tests.served import Served

LIMIT_S, STORM = 60.0, 50
TOML = "[service]\nopen = false\n[emulated]\nspeed = 1000\n"


def block(name: str) -> str:
    """The body of a fenced block of the page."""
    text = (ROOT / "docs/how-to/connect-a-mes.md").read_text(encoding="utf-8")
    return next(m["body"] for m in FENCE.finditer(text) if m["info"].strip().endswith(f" {name}"))


@pytest.fixture
def served(tmp_path: Path) -> Served:
    """A station that lets a MES in, not started yet; the key is beside it."""
    key = new_secret("fbs_")
    (tmp_path / "key").write_text(key)
    store = Store(tmp_path / "station.db")
    store.add_key(Actor(name="root", via="terminal"), "line 4", "mes", secret_hash(key), None)
    store.close()
    return Served(tmp_path, TOML)


def environment(served: Served) -> dict[str, str]:
    return {**os.environ, "STATION": served.url, "PYTHONPATH": str(ROOT / "web/client")}


def job(served: Served) -> subprocess.Popen[str]:
    (served.home / "mes_job.py").write_text(block("mes_job.py"), encoding="utf-8")
    return subprocess.Popen(
        [sys.executable, "mes_job.py", "WO-7", "FB-1"],
        cwd=served.home,
        env=environment(served),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def wait_for_readings(served: Served) -> None:
    """Until a run has begun to measure."""
    deadline_s = time.monotonic() + LIMIT_S
    store = Store(served.home / "station.db")
    try:
        while not [run for run in store.calibrations().items if store.readings(run.id)]:
            assert time.monotonic() < deadline_s
            time.sleep(0.02)
    finally:
        store.close()


def the_same_with_curl(served: Served) -> None:
    done = subprocess.run(
        ["sh", "-euc", block("curl")],
        cwd=served.home,
        env=environment(served),
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["items"][-1]["type"] == "run.ended"
    assert json.loads((served.home / "result.json").read_text())["work_order"] == "WO-8"
    assert (served.home / "readings.csv").read_text().startswith("reading,")


def storm(clients: ThreadPoolExecutor, mes: Station, times: int) -> list[Future[CalibrationSummary]]:
    """The job's own start, so many times at once."""
    order = CalibrationBody(robot_serial="FB-1", plan="rapid", operator="line 4", work_order="WO-7")
    return [clients.submit(mes.start, order, "WO-7/1") for _ in range(times)]


@pytest.mark.skipif(shutil.which("curl") is None, reason="curl is not there")
def test_the_job_goes_on_after_kills_of_both_sides(served: Served) -> None:
    served.start()
    key = (served.home / "key").read_text()
    with ThreadPoolExecutor(STORM) as clients, Station(served.url, key) as mes:
        started = storm(clients, mes, STORM)
        first = job(served)
        wait_for_readings(served)
        first.kill()
        first.communicate()
        second = job(served)
        started += storm(clients, mes, STORM // 5)
        served.kill()
        with served:
            assert {one.result(LIMIT_S).id for one in started} == {1}, "one run, killed in between"
            said, _ = second.communicate(timeout=LIMIT_S)
            the_same_with_curl(served)
    assert second.returncode == 0, said
    assert re.search(r"WO-7: run 2 succeeded, verdict pass: ", said)
    kept = json.loads((served.home / "WO-7.json").read_text())
    assert (kept["id"], kept["work_order"]) == (2, "WO-7")
    store = Store(served.home / "station.db")
    try:
        states = [run.state for run in store.calibrations(order="oldest").items]
    finally:
        store.close()
    assert states[:2] == ["interrupted", "succeeded"], "one run an attempt, however often it was asked for"
