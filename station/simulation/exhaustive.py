"""All small cases, without random draws: all orders of eight events, a failure at every write.

Each case is a separate station with one passed calibration, so that there is one to apply.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from itertools import product
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Literal, get_args

from drivers.emulated.orders import FaultOrder
from drivers.emulated.spec import MachineSpec
from station.records import CalibrationRequest, PlanName
from station.simulation.disk import FOR_GOOD, DiskTrouble
from station.simulation.keeper import Keeper, Stranded
from station.simulation.plant import Plant
from station.simulation.site import Site
from station.simulation.witness import Violation, Witness
from station.simulation.years import prepared

Event = Literal["submit", "abort", "stop", "fault", "kill", "restart", "apply", "roll back"]
EVENTS: tuple[Event, ...] = get_args(Event)
Deed = Literal["measure", "apply"]
_SPEC = MachineSpec(seed=7, zero_offsets_deg=(0.5, -0.4), drm_mm=(1.0, 0.5))
_PAUSES_S = (0.0, 0.3, 2.0)
_OFF_S = 1.0


@dataclass(frozen=True, slots=True)
class Order:
    """Some events in sequence."""

    events: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class WriteThatFails:
    """A failure during an action, from the n-th write to the disk on."""

    deed: Deed
    trouble: DiskTrouble | Literal["kill"]
    write: int
    times: int = 1


Case = Order | WriteThatFails


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a case."""

    case: Case
    reached: bool
    """False if the action has fewer writes than that."""
    violations: tuple[Violation, ...]


def orders(depth: int) -> list[Order]:
    """Every order of `depth` of the eight events, repeats included."""
    return [Order(events) for events in product(EVENTS, repeat=depth)]


def writes_that_fail() -> list[WriteThatFails]:
    """Every write of a measurement and an application: it fails, all from it on fail, or a kill at it."""
    kinds: tuple[tuple[DiskTrouble | Literal["kill"], int], ...] = (
        ("error", 1),
        ("full", FOR_GOOD),
        ("kill", 1),
    )
    deeds: tuple[Deed, ...] = ("measure", "apply")
    return [
        WriteThatFails(deed, trouble, write, times)
        for deed in deeds
        for trouble, times in kinds
        for write in range(_writes_of(deed))
    ]


def _writes_of(deed: Deed) -> int:
    """Number of its writes when nothing fails."""
    with _station() as keeper:
        keeper.start()
        first = keeper.plant.disk.writes
        _let_happen(keeper, "submit" if deed == "measure" else "apply", "the deed")
        keeper.plant.scheduler.wait(lambda: keeper.orchestrator.running is None)
        return keeper.plant.disk.writes - first


def carried_out(case: Case) -> Outcome:
    """Carry out one case on a separate station."""
    reached = True
    with _station(repr(case)) as keeper:
        with suppress(Stranded):
            keeper.start()
            if isinstance(case, Order):
                _in_order(keeper, case)
            else:
                reached = _failing(keeper, case)
            _settled(keeper)
        return Outcome(case, reached, tuple(keeper.witness.violations))


@contextmanager
def _station(seed: str = "") -> Iterator[Keeper]:
    """A station with a passed calibration; not started."""
    with TemporaryDirectory() as folder, prepared():
        home = Path(folder) / "home"
        calibrated, taken = _calibrated()
        shutil.copytree(calibrated.name, home)
        plant = Plant(home, [_SPEC], Random(seed), Site.instant())
        for receiver in plant.receivers.values():
            receiver.taken = list(taken)
        with plant.entered():
            yield Keeper(plant, Witness(plant))
            plant.scheduler.end()


@cache
def _calibrated() -> tuple[TemporaryDirectory[str], tuple[tuple[int, str], ...]]:
    """The data folder of a station with one passed calibration, and the events accepted by its receiver.

    Made once in each process; the folder is deleted at its end.
    """
    folder = TemporaryDirectory(prefix="calibrated-")
    plant = Plant(Path(folder.name), [_SPEC], Random(1), Site.instant())
    keeper = Keeper(plant, Witness(plant))
    with plant.entered():
        keeper.start()
        _measure(keeper, "first")
        keeper.come_to_rest()
        keeper.end()
        plant.scheduler.end()
    return folder, tuple(plant.receivers["plant"].taken)


def _in_order(keeper: Keeper, case: Order) -> None:
    plant, random = keeper.plant, Random(repr(case))
    for number, event in enumerate(case.events):
        with keeper.answered():
            _let_happen(keeper, event, f"event {number}")
        plant.scheduler.wait(seconds=random.choice(_PAUSES_S))


def _let_happen(keeper: Keeper, event: Event, key: str) -> None:
    plant = keeper.plant
    match event:
        case "submit":
            _measure(keeper, key)
        case "apply":
            plant.ask(lambda station: station.follow("apply", 1, "ada", idempotency_key=key))
        case "roll back":
            plant.ask(lambda station: station.follow("rollback", 1, "ada", idempotency_key=key))
        case "abort":
            plant.ask(lambda station: station.abort(station.running or 1, "ada"))
        case "stop":
            keeper.stop()
        case "fault":
            plant.orders.replace([FaultOrder(device="axis1", kind="silent", for_s=1.5)])
        case "kill" if plant.runs:
            plant.kill()
        case "restart":
            if plant.runs:
                keeper.shut_down()
            keeper.restart(_OFF_S)
        case _:
            pass


def _measure(keeper: Keeper, key: str, kind: Literal["calibrate", "check"] = "calibrate") -> None:
    plan: PlanName = "paper" if kind == "calibrate" else "check"
    request = CalibrationRequest(keeper.plant.serials[0], kind, "ada", plan)
    keeper.witness.started(
        key, keeper.plant.ask(lambda station: station.submit(request, idempotency_key=key).id)
    )


def _failing(keeper: Keeper, case: WriteThatFails) -> bool:
    """Whether the action reached the write that was to fail."""
    plant = keeper.plant
    first = plant.disk.writes
    if case.trouble != "kill":
        plant.disk.fail(case.trouble, after=case.write, times=case.times)
    with keeper.answered():
        _let_happen(keeper, "submit" if case.deed == "measure" else "apply", "the deed")

    def reached() -> bool:
        return plant.disk.writes > first + case.write

    kills = case.trouble == "kill"
    plant.scheduler.wait(lambda: keeper.orchestrator.running is None or (kills and reached()))
    if kills and reached():
        plant.kill()
    plant.scheduler.wait(seconds=2.0)
    plant.disk.mend()
    return reached()


def _settled(keeper: Keeper) -> None:
    """Recover after any event; then an undisturbed run succeeds."""
    plant = keeper.plant
    if not plant.runs:
        keeper.restart(_OFF_S)
    keeper.come_to_rest()
    plant.orders.replace(())
    with keeper.answered():
        _measure(keeper, "last", "check")
    if (run := keeper.orchestrator.running) is None:
        keeper.witness.fails("idle", "at rest, and no run may start")
        return
    keeper.come_to_rest()
    keeper.witness.undisturbed(run, keeper.store)
    keeper.end()
