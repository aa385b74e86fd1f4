"""Starts the station, brings it to rest, ends it; the witness checks it each time."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from station.errors import Busy, InputRefused, NotApplicable, NotFound, StoreUnavailable
from station.service import Orchestrator
from station.simulation.plant import NotRunning, Plant
from station.simulation.witness import Witness
from station.store import Store

REFUSALS = (Busy, InputRefused, NotApplicable, NotFound, StoreUnavailable)
RUN_LIMIT_S = 1800.0
"""Virtual time within which every run ends by itself, with or without answers to prompts."""
DELIVERY_LIMIT_S = 300.0


class Stranded(Exception):
    """The simulation cannot continue; the witness has the cause."""


@dataclass
class Keeper:
    """The keeper of one station."""

    plant: Plant
    witness: Witness
    restarts: int = 0
    """Number of restarts after kills."""

    @property
    def store(self) -> Store:
        """Store of the running station."""
        assert self.plant.runtime is not None
        return self.plant.runtime.store

    @property
    def orchestrator(self) -> Orchestrator:
        """Orchestrator of the running station."""
        assert self.plant.runtime is not None
        return self.plant.runtime.orchestrator

    def start(self) -> None:
        """Start it; the witness observes it from then on. :raises Stranded: it does not start."""
        if not self.plant.start():
            self.witness.fails("start", f"the station does not start: {self.plant.refusal}")
            raise Stranded
        self.orchestrator.subscribe(self.witness.heard)
        self.witness.look(self.store)

    def restart(self, after_s: float) -> None:
        """Restart it after a kill and a delay. :raises Stranded:"""
        self.restarts += 1
        off_s = self.plant.scheduler.now_s
        self.plant.scheduler.wait(seconds=after_s)
        self.witness.off(off_s)
        self.start()

    @contextmanager
    def answered(self) -> Iterator[None]:
        """Context of a request: a refusal, or a missing answer because of a kill, is accepted."""
        try:
            yield
        except (NotRunning, *REFUSALS):
            pass
        except Exception as error:  # noqa: BLE001 - whatever else it is must not be
            self.witness.fails("answer", f"{type(error).__name__}: {error}")

    def come_to_rest(self) -> None:
        """Wait until no run is active and the arm is inside; the stored data agree with the reported ones.

        :raises Stranded: it does not come to rest.
        """
        orchestrator = self.orchestrator
        if not self.plant.scheduler.wait(lambda: orchestrator.running is None, RUN_LIMIT_S):
            self.witness.fails("idle", f"run {orchestrator.running} does not end")
            raise Stranded
        self.plant.scheduler.wait(seconds=2.0)  # ends that the disk refused are repeated meanwhile
        orchestrator.snapshot().model_dump_json()
        self.witness.look(self.store)
        if orchestrator.snapshot().retract.needed:
            self._retract()

    def end(self) -> None:
        """End it regularly, after all deliveries. :raises Stranded: it does not end."""
        self.deliver_all()
        self.witness.look_at_all(self.store)
        self.shut_down()

    def stop(self) -> None:
        """Press STOP. :raises: as `Plant.ask`"""
        pressed_s = self.plant.scheduler.now_s
        self.witness.stopped(pressed_s, self.plant.ask(lambda station: station.stop("ada")))

    def shut_down(self) -> None:
        """End it at once, in any state. :raises Stranded: it does not end."""
        if not self.plant.end():
            self.witness.fails("idle", "the station does not end")
            raise Stranded

    def deliver_all(self) -> None:
        """Wait until the receiver has all events."""
        world = self.plant.scheduler
        for receiver in self.plant.receivers.values():
            receiver.fails = 0.0
        world.wait(seconds=2.0)  # until the courier has processed the last end
        limit_s = world.now_s + DELIVERY_LIMIT_S
        while self.store.backlogs() and world.now_s < limit_s:
            world.wait(seconds=1.0)
        for backlog in self.store.backlogs():
            self.witness.fails("deliveries", f"{backlog.count} events wait still")

    def _retract(self) -> None:
        orchestrator = self.orchestrator
        try:
            run = self.plant.ask(lambda station: station.retract("ada").id)
        except REFUSALS as refusal:
            self.witness.fails("idle", f"the arm is outside, and retract is refused: {refusal}")
            raise Stranded from refusal
        self.plant.scheduler.wait(lambda: orchestrator.running is None, RUN_LIMIT_S)
        if orchestrator.snapshot().retract.needed:
            self.witness.fails("idle", f"run {run} did not bring the arm back")
            raise Stranded
