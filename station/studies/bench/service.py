"""A run from POST to the stored record, its bytes, and the first page of a long history, over HTTP."""

from __future__ import annotations

import json
import socket
import sqlite3
import time
from contextlib import closing
from dataclasses import dataclass
from http.client import HTTPConnection
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from websockets.sync.client import connect

from station.records import uid7
from station.settings import database_path
from station.studies.bench.served import SETTINGS, serving
from station.studies.bench.timing import Figure, figure, time_ms

RUNS = 200
WARM_UP = 20
PATH = "/api/v1/calibrations"
A_MINUTE_MS = 60_000
BATCH = 50_000


def runs() -> dict[str, Figure]:
    """{run_http_ms, bytes_per_run} of six-step runs without motion."""
    with TemporaryDirectory() as folder:
        home = Path(folder)
        _run_times(home, WARM_UP)
        before = _size(home)
        times = _run_times(home, RUNS)
        bytes_each = (_size(home) - before) / RUNS
    return {
        "run_http_ms": figure(times),
        "bytes_per_run": {"median": bytes_each, "min": bytes_each, "n": RUNS},
    }


def _run_times(home: Path, count: int) -> list[float]:
    """ms from POST until the live feed has told the end and the record is read back."""
    body = {"robot_serial": "B-1", "plan": "paper", "operator": "bench"}
    taken = []
    with (
        serving(home) as port,
        closing(connected(port)) as http,
        connect(f"ws://127.0.0.1:{port}/api/v1/live") as feed,
    ):
        for _ in range(count):
            begun = time.perf_counter()
            run = _json(http, "POST", PATH, body)["id"]
            while json.loads(feed.recv())["type"] != "ended":
                pass
            record = _json(http, "GET", f"{PATH}/{run}")
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
        _run_times(home, 1)
        _fill(database_path(SETTINGS, home), count)
        with serving(home) as port, closing(connected(port)) as http:
            page = _get(http)
            return {"ms": time_ms(lambda: _get(http), most=200), "page_bytes": len(page)}


def _fill(path: Path, count: int) -> None:
    """Copies of the one run that is there, a minute apart."""
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA synchronous = OFF")
        calibration, result = (_Pattern.of(connection, table) for table in ("calibrations", "results"))
        numbers = iter(range(2, count + 1))
        while batch := list(islice(numbers, BATCH)):
            with connection:
                connection.executemany(
                    calibration.insert, (calibration.copy(id=k, uid=uid7()) for k in batch)
                )
                connection.executemany(result.insert, (result.copy(calibration_id=k) for k in batch))


@dataclass(frozen=True)
class _Pattern:
    """A row to make others from."""

    insert: str
    row: dict[str, Any]

    @classmethod
    def of(cls, connection: sqlite3.Connection, table: str) -> _Pattern:
        found = connection.execute(f"SELECT * FROM {table}")
        row = dict(zip((column[0] for column in found.description), found.fetchone(), strict=True))
        return cls(f"INSERT INTO {table} VALUES ({', '.join('?' * len(row))})", row)

    def copy(self, **key: int | str) -> tuple[Any, ...]:
        """The same with another key, its times as much later as the number that the key begins with."""
        number = int(next(iter(key.values())))
        later = {
            name: value + number * A_MINUTE_MS for name, value in self.row.items() if name.endswith("_ms")
        }
        return tuple({**self.row, **later, **key}.values())


def connected(port: int) -> HTTPConnection:
    http = HTTPConnection("127.0.0.1", port, timeout=30)
    http.connect()
    http.sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return http


def _get(http: HTTPConnection) -> bytes:
    http.request("GET", PATH)
    return http.getresponse().read()


def _json(http: HTTPConnection, method: str, path: str, body: dict[str, str] | None = None) -> dict[str, Any]:
    http.request(method, path, json.dumps(body) if body else None, {"Content-Type": "application/json"})
    answer = http.getresponse()
    content = answer.read()
    if answer.status >= 400:
        raise RuntimeError(f"{method} {path} answers {answer.status}: {content.decode()}")
    found: dict[str, Any] = json.loads(content)
    return found
