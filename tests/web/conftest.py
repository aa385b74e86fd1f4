"""A station on fake devices behind the real application; nothing is left behind."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import uvicorn
from argon2 import PasswordHasher
from fastapi import FastAPI
from fastapi.testclient import TestClient

from station.motion import EmulatedRig
from station.people import new_secret, passwords, secret_hash
from station.records import Actor, Role
from station.service.orchestrator import Orchestrator
from station.service.runtime import Runtime
from station.settings import ServiceSettings, Settings
from station.store.store import Store
from tests.station.asking import kinds_with
from tests.station.conftest import SETTINGS
from tests.station.fakes import Rig, make_rig, two_sequences
from tests.waiting import all_threads_end, soon
from web.app import create_app

passwords._hasher = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
"""The real cost, 64 MB and a processor for a moment, is tested in tests/station/people."""
BODY = {"robot_serial": "FB-1", "plan": "paper", "operator": "ada"}
LIMIT_S = 10.0


@pytest.fixture(autouse=True)
def no_thread_left() -> Iterator[None]:
    with all_threads_end():
        yield


@dataclass
class Service:
    """The application and its parts."""

    client: TestClient
    runtime: Runtime
    rig: Rig
    patch: pytest.MonkeyPatch

    def start(self, key: str | None = None, **changes: Any) -> Any:
        headers = {"Idempotency-Key": key} if key else {}
        return self.client.post("/api/v1/calibrations", json={**BODY, **changes}, headers=headers)

    def hold(self) -> int:
        """Start a run that continues until it is aborted; returns its id."""
        self.patch.setattr("station.motion.positioner._ARRIVAL_MARGIN_S", 600.0)
        self.rig.axes[0].stuck = True
        before = self.rig.script.calls.count("axis 1 move_to")
        run = int(self.start().json()["id"])
        self.wait_for("axis 1 move_to", before + 1)
        return run

    def key(self, role: Role, name: str | None = None, **more: Any) -> dict[str, str]:
        """The header with a new key of this role."""
        key = new_secret("fbs_")
        by = Actor(name="root", via="terminal")
        expires_at = more.get("expires_at")
        self.runtime.store.add_key(by, name or f"a {role}", role, secret_hash(key), expires_at)
        return {"Authorization": f"Bearer {key}"}

    def complete(self, **changes: Any) -> int:
        """One run from start to end; returns its id."""
        run = int(self.start(**changes).json()["id"])
        assert self.runtime.orchestrator.wait(run, LIMIT_S).ended
        return run

    def device(self, name: str) -> dict[str, Any]:
        """The station's data of a device."""
        devices: list[dict[str, Any]] = self.client.get("/api/v1/station").json()["devices"]
        return next(device for device in devices if device["name"] == name)

    def wait_for(self, call: str, times: int = 1) -> None:
        """Wait until the worker has made this call to a device this many times."""
        soon(lambda: self.rig.script.calls.count(call) >= times, f"no {call}")


@pytest.fixture
def service(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Service]:
    """An open service, as with the emulated rig on a loopback address."""
    with a_service(tmp_path, monkeypatch) as made:
        yield made


@pytest.fixture
def closed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Service]:
    """A service where everybody has to sign in."""
    service = ServiceSettings(open=False)
    with a_service(tmp_path, monkeypatch, SETTINGS.model_copy(update={"service": service})) as made:
        yield made


@pytest.fixture(scope="module")
def emulated_rig(tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmulatedRig]:
    emulated = EmulatedRig(None, tmp_path_factory.mktemp("rig") / "state.json", 50.0)
    yield emulated
    emulated.close()


@contextmanager
def a_service(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, settings: Settings = SETTINGS
) -> Iterator[Service]:
    with a_runtime(tmp_path, settings) as (runtime, rig):
        # a failure inside the service must be returned as its answer, not as the test's exception
        client = TestClient(create_app(runtime), base_url="http://station", raise_server_exceptions=False)
        with client:
            yield Service(client, runtime, rig, monkeypatch)


@contextmanager
def a_runtime(tmp_path: Path, settings: Settings = SETTINGS) -> Iterator[tuple[Runtime, Rig]]:
    rig = make_rig()
    with ExitStack() as opened:
        store = Store(tmp_path / "station.db")
        opened.callback(store.close)
        orchestrator = Orchestrator(rig.devices, store, settings, kinds_with(two_sequences))
        opened.callback(orchestrator.shutdown)
        opened.callback(rig.released.set)
        _wait_for_devices(orchestrator)
        yield Runtime(settings, tmp_path, store, orchestrator, ExitStack()), rig


def _wait_for_devices(orchestrator: Orchestrator) -> None:
    """Wait until they are connected: a stop before that has no confirmation."""
    soon(lambda: all(device.state != "unknown" for device in orchestrator.snapshot().devices))


@contextmanager
def listening(app: FastAPI) -> Iterator[int]:
    """The application behind a real socket of this computer; returns its port."""
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        config = uvicorn.Config(app, log_config=None, access_log=False, proxy_headers=False)
        server = uvicorn.Server(config)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        try:
            soon(lambda: server.started or not thread.is_alive())
            assert server.started
            yield int(listener.getsockname()[1])
        finally:
            server.should_exit = True
            thread.join()
