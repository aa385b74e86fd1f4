"""The service on instant devices, as a process of its own: real HTTP, real SQLite file."""

from __future__ import annotations

import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from threading import Thread

import uvicorn

from station.plans import make_plan
from station.published import MAX_PASSES, PublishedRun
from station.records import MeasurementSequence, Procedure
from station.run_kinds import RUN_KINDS, Start
from station.service import Orchestrator, Runtime
from station.settings import LimitSettings, Settings, database_path
from station.store import Store
from station.studies.bench.instant import instant_devices
from web.app import create_app

SETTINGS = Settings(limits=LimitSettings(settle_s=0.0))


def six_steps(start: Start) -> Procedure:
    """One sequence over the six positions, the published iteration on its readings."""
    run = PublishedRun(start.robot)
    readings = yield MeasurementSequence("Measuring", 1, make_plan("paper", start.robot).stops)
    for _ in range(MAX_PASSES):
        run.absorb(readings)
        if run.converged:
            break
    return run.result()


KINDS = {**RUN_KINDS, "calibrate": replace(RUN_KINDS["calibrate"], procedure=six_steps)}


@contextmanager
def serving(home: Path) -> Iterator[int]:
    """Start it on a home folder; its port."""
    program = f"from {__name__} import _serve; _serve({str(home)!r})"
    command = [sys.executable, "-c", program]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdin is not None and process.stdout is not None
    try:
        yield int(process.stdout.readline())
    finally:
        process.stdin.close()
        process.wait()
        process.stdout.close()


def _serve(folder: str) -> None:
    home = Path(folder)
    with ExitStack() as opened:
        store = Store(database_path(SETTINGS, home))
        opened.callback(store.close)
        orchestrator = Orchestrator(instant_devices(), store, SETTINGS, KINDS)
        opened.callback(orchestrator.shutdown)
        application = create_app(Runtime(SETTINGS, home, store, orchestrator, ExitStack()))
        server = uvicorn.Server(uvicorn.Config(application, log_config=None, access_log=False))
        # named, because asyncio otherwise leaves Nagle's delay on: 40 ms per answer
        listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
        opened.enter_context(listener)
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        Thread(target=_until_input_closes, args=(server,), daemon=True).start()
        print(listener.getsockname()[1], flush=True)
        server.run(sockets=[listener])


def _until_input_closes(server: uvicorn.Server) -> None:
    sys.stdin.read()
    server.should_exit = True
