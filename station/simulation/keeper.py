"""Starts the station, lets it come to rest, ends it; each time the witness looks."""

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
"""Virtual time within which every run ends by itself, prompts answered or not."""
DELIVERY_LIMIT_S = 300.0


class Stranded(Exception):
    """It cannot go on; the witness knows why."""


@dataclass
class Keeper:
    """Of one station."""

    plant: Plant
    witness: Witness
    restarts: int = 0
    """After kills."""

    @property
    def store(self) -> Store:
        """Of the station that runs."""
        assert self.plant.runtime is not None
        return self.plant.runtime.store

    @property
    def orchestrator(self) -> Orchestrator:
        """Of the station that runs."""
        assert self.plant.runtime is not None
        return self.plant.runtime.orchestrator

    def start(self) -> None:
        """The witness watches from then on.  :raises Stranded: it does not start."""
        if not self.plant.start():
            self.witness.fails("start", f"the station does not start: {self.plant.refusal}")
            raise Stranded
        self.orchestrator.subscribe(self.witness.heard)
        self.witness.look(self.store)

    def restart(self, after_s: float) -> None:
        """After a kill, so much later.  :raises Stranded:"""
        self.restarts += 1
        off_s = self.plant.scheduler.now_s
        self.plant.scheduler.wait(seconds=after_s)
        self.witness.off(off_s)
        self.start()

    @contextmanager
    def answered(self) -> Iterator[None]:
        """A request: refused in a sentence, or not heard because the station was killed, is all right."""
        try:
            yield
        except (NotRunning, *REFUSALS):
            pass
        except Exception as error:  # noqa: BLE001 - whatever else it is must not be
            self.witness.fails("answer", f"{type(error).__name__}: {error}")

    def come_to_rest(self) -> None:
        """No run is under way and the arm stands inside; everything that is kept is as it was told.

        :raises Stranded: it does not come to rest.
        """
        orchestrator = self.orchestrator
        if not self.plant.scheduler.wait(lambda: orchestrator.running is None, RUN_LIMIT_S):
            self.witness.fails("idle", f"run {orchestrator.running} does not end")
            raise Stranded
        self.plant.scheduler.wait(seconds=2.0)  # ends that the disk did not take are repeated meanwhile
        orchestrator.snapshot().model_dump_json()
        self.witness.look(self.store)
        if orchestrator.snapshot().retract.needed:
            self._retract()

    def end(self) -> None:
        """In order, when everything was delivered.  :raises Stranded: it does not end."""
        self.deliver_all()
        self.witness.look_at_all(self.store)
        self.shut_down()

    def stop(self) -> None:
        """Somebody presses STOP.  :raises: as `Plant.ask`"""
        pressed_s = self.plant.scheduler.now_s
        self.witness.stopped(pressed_s, self.plant.ask(lambda station: station.stop("ada")))

    def shut_down(self) -> None:
        """At once, whatever runs.  :raises Stranded: it does not end."""
        if not self.plant.end():
            self.witness.fails("idle", "the station does not end")
            raise Stranded

    def deliver_all(self) -> None:
        """Wait until the receiver has everything."""
        world = self.plant.scheduler
        for receiver in self.plant.receivers.values():
            receiver.fails = 0.0
        world.wait(seconds=2.0)  # until the courier has seen the last end
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
