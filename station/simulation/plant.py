"""A plant in virtual time: machines and their wires, a disk, a wall clock, and the station.

The station is the production code from `Runtime.open` on.  The emulated machine and its devices are those of
the emulated rig, on simulated wires instead of a pseudo-terminal and a socket.
"""

from __future__ import annotations

import datetime as dates_of_python
import queue
import secrets
import sqlite3
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from typing import ParamSpec, Protocol, TypeVar

from fastapi import FastAPI
from starlette.types import Message, Scope

from drivers.emulated.drive import EmulatedDrive
from drivers.emulated.faults import Faults
from drivers.emulated.machine import Machine
from drivers.emulated.orders import Orders
from drivers.emulated.spec import MachineSpec
from drivers.emulated.spoiled import ReadoutOnLine, SpoiledDrive
from drivers.lines import NetAddress, Port, SerialAddress, open_port
from station.identification import identify
from station.outbox import Folder
from station.service import Orchestrator, Runtime
from station.settings import Settings
from station.simulation.clocks import Clocks, DrawnSecrets, dates
from station.simulation.disk import CutOff, Disk
from station.simulation.loops import VirtualLoop, threads_of_requests
from station.simulation.receiver import Receiver
from station.simulation.scheduler import Process, Scheduler
from station.simulation.site import Site
from station.simulation.substitution import substituted
from station.simulation.threads import Threads
from station.simulation.wires import Wires
from web.app import create_app

T = TypeVar("T")
P = ParamSpec("P")

START_LIMIT_S = 60.0
END_LIMIT_S = 60.0


class Exchange(Protocol):
    """The client's end of a request."""

    done: bool
    """Whether the answer is complete."""

    async def receive(self) -> Message:
        """Next message from the client."""

    async def send(self, message: Message) -> None:
        """A message of the answer."""


class NotRunning(Exception):
    """The station does not run, or was killed before it answered."""


class Plant:
    """Everything outside the station's process; a context manager."""

    def __init__(
        self, home: Path, specs: list[MachineSpec], random: Random, site: Site | None = None
    ) -> None:
        """:param specs: the robots, one of which is at the station at a time"""
        self.home = home
        self.site = site or Site()
        self.random = random
        self.scheduler = Scheduler(Random(random.random()))
        self.clocks = Clocks(self.scheduler)
        self.disk = Disk(self.scheduler)
        self.orders = Orders(clock=lambda: self.scheduler.now_s)
        self.machines = [Machine(spec, lambda: self.scheduler.now_s, speed=self.site.haste) for spec in specs]
        self.serials = [f"SIM-{number}" for number in range(1, len(specs) + 1)]
        self.first_offsets_deg = [spec.zero_offsets_deg for spec in specs]
        """True zero offsets before any zero was written."""
        self.receivers = {
            name: Receiver(self.scheduler, Random(random.random()), name) for name in ("plant", "office")
        }
        self.settings = Settings.model_validate(
            {
                **self.site.settings,
                "outbox": {"folder": [{"path": name, "events": ["run.ended"]} for name in self.receivers]},
            }
        )
        self.runtime: Runtime | None = None
        self.refusal: str | None = None
        """Why the last start failed."""
        self._process: Process | None = None
        self._app: FastAPI | None = None
        self._ending = False
        self._mounted = 0
        self._drives: tuple[EmulatedDrive, ...] = ()
        self._wires: Wires | None = None

    @contextmanager
    def entered(self) -> Iterator[None]:
        """Production code runs in this plant until the block ends."""
        threads = Threads(self.scheduler)
        replacements: dict[object, object] = {
            time: self.clocks,
            time.monotonic: self.clocks.monotonic,
            dates_of_python.datetime: dates(self.clocks),
            secrets: DrawnSecrets(Random(self.random.random())),
            sqlite3: self.disk,
            threading.Thread: threads.Thread,
            threading.Event: threads.Event,
            threading.Lock: threads.Lock,
            threading.RLock: threads.RLock,
            threading.Condition: threads.Condition,
            threading.get_ident: threads.get_ident,
            queue.Queue: threads.Queue,
            Folder: lambda settings: self.receivers[str(settings.path)],
            open_port: self._open_port,
            identify: self._computed(identify),
        }
        with substituted(replacements), threads_of_requests(self.scheduler):
            self._switch_on()
            yield

    def _computed(self, function: Callable[P, T]) -> Callable[P, T]:
        """The same, with the computing time of this site."""

        def takes_time(*args: P.args, **kwargs: P.kwargs) -> T:
            self.scheduler.wait(seconds=self.site.computing_s)
            return function(*args, **kwargs)

        return takes_time

    # The machine -----------------------------------------------------------------------------------

    @property
    def machine(self) -> Machine:
        """The robot at the station."""
        return self.machines[self._mounted]

    @property
    def robot(self) -> int:
        """Its number."""
        return self._mounted

    def bring(self, number: int) -> None:
        """Exchange the robot at the station; only while the station is off."""
        self._mounted = number
        self._switch_on()

    def _switch_on(self) -> None:
        """Readout and drives of the robot at the station."""
        for drive in self._drives:
            drive.close()
        faults, machine = Faults(), self.machine
        self._drives = tuple(self.site.drive(machine, joint, faults) for joint in (1, 2))
        readout = self.site.readout(machine, faults, self.clocks.monotonic)
        gateway = self.site.line == "tcp"
        spoiled = [
            SpoiledDrive(drive, joint, self.orders, behind_gateway=gateway)
            for joint, drive in enumerate(self._drives, start=1)
        ]
        self._wires = Wires(
            self.scheduler,
            self.site,
            ReadoutOnLine(readout, self.orders).receive,
            {joint: drive.answer for joint, drive in enumerate(spoiled, start=1)},
            self._drives[0].check_sum_exception,
        )

    def _open_port(self, address: SerialAddress | NetAddress, xonxoff: bool) -> Port:
        assert self._wires is not None
        return self._wires.open_port(address, xonxoff)

    # The station -----------------------------------------------------------------------------------

    @property
    def runs(self) -> bool:
        """Whether the station's process is alive and has opened."""
        return self.runtime is not None and self._process is not None and not self._process.killed

    def start(self) -> bool:
        """Start the station; returns whether it succeeded. The cause of a failure is in `refusal`."""
        self._process = Process("station")
        self._ending, self.refusal, self.runtime = False, None, None
        task = self.scheduler.spawn(self._live, "station", self._process)
        self.scheduler.wait(lambda: self.runtime is not None or task.ended, START_LIMIT_S)
        return self.runs

    def end(self) -> bool:
        """End it regularly, as SIGTERM does; returns whether it has ended in time."""
        self._ending = True
        process = self._process
        ended = process is None or self.scheduler.wait(
            lambda: not self.scheduler.tasks_of(process), END_LIMIT_S
        )
        self.runtime = None
        return ended

    def kill(self) -> None:
        """End it immediately, as kill -9 or a power failure does."""
        assert self._process is not None
        left = CutOff(self.home, self.home.with_name("cut-off"), self.random)
        self.scheduler.kill(self._process)
        self.runtime = None
        left.put_back()

    def ask(self, request: Callable[[Orchestrator], T]) -> T:
        """The answer of the station to a request, which a thread of its own process carries out.

        :raises NotRunning: it was killed before it answered, or does not run.
        :raises Exception: the error of the request.
        """
        runtime, process = self.runtime, self._process
        if runtime is None or process is None or process.killed:
            raise NotRunning
        answers: list[T] = []
        errors: list[Exception] = []

        def carry_out() -> None:
            try:
                answers.append(request(runtime.orchestrator))
            except Exception as error:  # noqa: BLE001 - handed to the one who asked
                errors.append(error)

        task = self.scheduler.spawn(carry_out, "request", process)
        self.scheduler.wait(lambda: task.ended)
        if errors:
            raise errors[0]
        if not answers:
            raise NotRunning
        return answers[0]

    def serve(self, scope: Scope, exchange: Exchange) -> None:
        """Let the station's application serve a request; returns when it is answered, or cannot be any more.

        :raises NotRunning: the station does not run
        """
        process, app = self._process, self._app
        if not self.runs or process is None or app is None:
            raise NotRunning

        def serving() -> None:
            loop = VirtualLoop(self.scheduler)
            try:
                loop.run_until_complete(app(scope, exchange.receive, exchange.send))
            finally:
                loop.close()

        task = self.scheduler.spawn(serving, f"request {scope['path']}", process)
        self.scheduler.wait(lambda: exchange.done or task.ended)

    def _live(self) -> None:
        try:
            with Runtime.open(self.settings, self.home) as runtime:
                app = create_app(runtime)
                if self._app is not None:  # its routes are ready, which takes as long as a run
                    self._app.state = app.state
                self._app = self._app or app
                self.runtime = runtime
                self.scheduler.wait(lambda: self._ending)
        except Exception as error:  # noqa: BLE001 - boundary of the process: what it says at its end
            self.refusal = f"{type(error).__name__}: {error}"
