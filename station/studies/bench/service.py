"""A run from POST to the stored record, its bytes, and the first page of a long history, over HTTP."""

from __future__ import annotations

import json
import socket
import time
from contextlib import closing
from http.client import HTTPConnection
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from websockets.sync.client import connect

from station.settings import database_path
from station.studies.bench.served import SETTINGS, serving
from station.studies.bench.timing import Figure, figure, time_ms
from station.studies.long_history import lengthen

RUNS = 200
WARM_UP = 20
PATH = "/api/v1/calibrations"


def runs() -> dict[str, Figure]:
    """{run_http_ms, bytes_per_run} of six-step runs without motion."""
    with TemporaryDirectory() as folder:
        home = Path(folder)
        run_times(home, WARM_UP)
        before = _size(home)
        times = run_times(home, RUNS)
        bytes_each = (_size(home) - before) / RUNS
    return {
        "run_http_ms": figure(times),
        "bytes_per_run": {"median": bytes_each, "min": bytes_each, "n": RUNS},
    }


def run_times(home: Path, count: int) -> list[float]:
    """ms of each run from POST until the live feed has told the end and the record is read back."""
    body = {"robot_serial": "B-1", "plan": "paper", "operator": "bench"}
    taken = []
    with (
        serving(home) as port,
        closing(connected(port)) as http,
        connect(f"ws://127.0.0.1:{port}/api/v1/live") as feed,
    ):
        for _ in range(count):
            begun = time.perf_counter()
            run = ask(http, "POST", PATH, body)["id"]
            while json.loads(feed.recv())["type"] != "ended":
                pass
            record = ask(http, "GET", f"{PATH}/{run}")
            taken.append((time.perf_counter() - begun) * 1e3)
            if record["state"] != "succeeded" or record["step"] != 6:
                raise RuntimeError(f"run {run}: {record['state']}, {record['reason']}")
    return taken


def _size(home: Path) -> int:
    """Bytes of the closed database."""
    return database_path(SETTINGS, home).stat().st_size


def history(count: int) -> dict[str, Any]:
    """{ms: Figure, page_bytes} of the first page with `count` runs stored.

    Runs have their result; their readings, which the list does not touch, are left out.
    """
    with TemporaryDirectory() as folder:
        home = Path(folder)
        run_times(home, 1)
        lengthen(database_path(SETTINGS, home), count, readings=False)
        with serving(home) as port, closing(connected(port)) as http:
            page = _get(http)
            return {"ms": time_ms(lambda: _get(http), most=200), "page_bytes": len(page)}


def connected(port: int) -> HTTPConnection:
    http = HTTPConnection("127.0.0.1", port, timeout=30)
    http.connect()
    http.sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return http


def _get(http: HTTPConnection) -> bytes:
    http.request("GET", PATH)
    return http.getresponse().read()


def ask(http: HTTPConnection, method: str, path: str, body: dict[str, str] | None = None) -> dict[str, Any]:
    """The JSON that is answered.  :raises RuntimeError: the request is refused"""
    http.request(method, path, json.dumps(body) if body else None, {"Content-Type": "application/json"})
    answer = http.getresponse()
    content = answer.read()
    if answer.status >= 400:
        raise RuntimeError(f"{method} {path} answers {answer.status}: {content.decode()}")
    found: dict[str, Any] = json.loads(content)
    return found
