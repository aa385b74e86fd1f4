"""Fixtures: a store, fake devices, an orchestrator on them; no thread is left behind."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from station.run_kinds import RUN_KINDS
from station.service.orchestrator import Orchestrator
from station.settings import LimitSettings, Settings
from station.store.store import Store
from tests.station.asking import ProcedureFactory, kinds_with
from tests.station.fakes import Rig, make_rig, two_sequences
from tests.waiting import all_threads_end

SETTINGS = Settings(limits=LimitSettings(settle_s=0.1, samples=2))


@pytest.fixture(autouse=True)
def no_thread_left() -> Iterator[None]:
    with all_threads_end():
        yield


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    store = Store(tmp_path / "station.db")
    yield store
    store.close()


@pytest.fixture
def rig() -> Iterator[Rig]:
    rig = make_rig()
    yield rig
    rig.released.set()


Start = Callable[..., Orchestrator]


@pytest.fixture
def start(store: Store, rig: Rig) -> Iterator[Start]:
    """Orchestrators on the fake rig; shut down at the end, after hanging calls were released."""
    with ExitStack() as opened:

        def start(
            procedure: ProcedureFactory | None = two_sequences, settings: Settings = SETTINGS
        ) -> Orchestrator:
            """With this procedure for whatever is measured by a plan; None: each kind with its own."""
            kinds = RUN_KINDS if procedure is None else kinds_with(procedure)
            orchestrator = Orchestrator(rig.devices, store, settings, kinds)
            opened.callback(orchestrator.shutdown)
            opened.callback(rig.released.set)
            return orchestrator

        yield start
