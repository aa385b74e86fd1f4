"""Readings over lines that disturb one request in a hundred, in every way that a station recovers from.

`python -m tests.drivers.random_faults [--readings N] [--rate P] [--rig SERVO,SCALE,LINE] [--seed S]`: the
whole station, its database included, moves an emulated machine without noise to random positions.  Each
stored reading, with every sample, is compared with the value that the machine's own physics gives for the
stored joint angles.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from random import Random
from threading import Lock
from unittest.mock import patch

import numpy as np

from drivers.emulated.machine import Machine
from drivers.emulated.orders import FaultOrder, Kind, Orders
from drivers.emulated.rig import EmulatedRig
from drivers.emulated.spec import EmulationSpec, MachineSpec, RigSpec
from drivers.emulated.virtual import VirtualClock
from station.five_bar import Robot, inverse
from station.motion import build_devices
from station.records import MeasurementSequence, PlanName, Procedure, Reading, State, Stop
from station.service import Orchestrator
from station.settings import DEFAULT_JOINTS, LimitSettings, Settings
from station.store import Store
from tests.station.asking import asked, kinds_with
from tests.station.fakes import result_of

SERVOS, SCALES, LINES = ("leadshine-el7", "orientalmotor"), ("heidenhain-nd", "siko"), ("tcp", "rtu")
RECOVERABLE: dict[str, tuple[Kind, ...]] = {
    "scale": ("silent", "late", "bad_crc", "short", "garbage", "twice"),
    "axis": (
        *("silent", "late", "bad_crc", "short", "garbage", "twice"),
        *("wrong_id", "wrong_function", "exception"),
    ),
}
STEP_MM = {"heidenhain-nd": 1e-4, "siko": 0.01}
LATE_S, SCALE_TIMEOUT_S, SERVO_TIMEOUT_S, WATCHDOG_MS = 0.3, 0.2, 0.1, 5000
STOPS_A_RUN = 250
LIMIT_S = 1800.0
MACHINE = MachineSpec(zero_offsets_deg=(0.3, -0.2), scale_noise_mm=0.0, scatter=False)
LIMITS = LimitSettings(speed_deg_s=150.0, settle_s=0.0, samples=3)


class RandomOrders(Orders):
    """Every request may be disturbed."""

    def __init__(self, rate: float, rng: Random) -> None:
        super().__init__()
        self._rate, self._rng, self._drawing = rate, rng, Lock()
        self.struck: Counter[str] = Counter()

    def due(self, kind: Kind, *devices: str) -> FaultOrder | None:
        kinds = RECOVERABLE.get(devices[0].rstrip("12"), ())
        if kind not in kinds:
            return None
        with self._drawing:
            if self._rng.random() >= self._rate / len(kinds):
                return None
            self.struck[f"{devices[0]} {kind}"] += 1
        return FaultOrder.model_validate({"device": devices[0], "kind": kind})


@dataclass
class Outcome:
    """The result of a test."""

    readings: int = 0
    wrong: list[str] = field(default_factory=list)
    failed: list[str] = field(default_factory=list)
    """Reasons of runs that ended early."""
    struck: Counter[str] = field(default_factory=Counter)

    @property
    def text(self) -> str:
        kinds = ", ".join(f"{kind} {n}" for kind, n in sorted(self.struck.items()))
        lines = [
            f"{self.readings} readings, {self.struck.total()} faults ({kinds})",
            f"{len(self.wrong)} wrong values stored; {len(self.failed)} runs ended early",
        ]
        return "\n".join([*lines, *self.wrong, *sorted(set(self.failed))])


def measured(servo: str, scale: str, line: str, readings: int, rate: float, seed: int) -> Outcome:
    """The given number of readings of one rig."""
    outcome = Outcome()
    orders = RandomOrders(rate, Random(f"{seed} faults"))
    places = Random(f"{seed} positions")
    with tempfile.TemporaryDirectory() as folder, _station(servo, scale, line, Path(folder), orders) as both:
        orchestrator, store, procedure = both
        while outcome.readings < readings and len(outcome.failed) < readings:
            procedure.stops = _stops(places, min(STOPS_A_RUN, readings - outcome.readings))
            run = orchestrator.submit(asked("R1", "rapid")).id
            orchestrator.wait(run, LIMIT_S)
            stored = store.readings(run)
            outcome.readings += len(stored)
            outcome.wrong += _wrong(stored, 0.5 * STEP_MM[scale])
            if store.summary(run).state is not State.SUCCEEDED:
                outcome.failed.append(store.summary(run).reason or "no reason")
    outcome.struck = orders.struck
    return outcome


class _ToPositions:
    """A procedure that only measures."""

    def __init__(self) -> None:
        self.stops: tuple[Stop, ...] = ()

    def __call__(self, plan: PlanName, robot: Robot) -> Procedure:
        readings = yield MeasurementSequence("Random positions", 1, self.stops)
        return result_of(readings)


@contextmanager
def _station(
    servo: str, scale: str, line: str, folder: Path, orders: Orders
) -> Iterator[tuple[Orchestrator, Store, _ToPositions]]:
    emulated = EmulationSpec.model_validate(
        {"servo": servo, "scale": scale, "line": line, "baud": 230_400, "speed": 1000.0}
    )
    rig = EmulatedRig(RigSpec(machine=MACHINE, emulated=emulated))
    rig.orders = orders
    watchdog = {"watchdog_ms": WATCHDOG_MS} if servo == "orientalmotor" else {}
    with (
        patch("drivers.emulated.spoiled.LATE_S", LATE_S),
        rig,
        closing(Store(folder / "station.db")) as store,
    ):
        settings = Settings.model_validate(
            {
                "scale": {**rig.scale_options, "timeout_s": SCALE_TIMEOUT_S},
                "servo": {
                    **rig.servo_options,
                    **watchdog,
                    "timeout_s": SERVO_TIMEOUT_S,
                    "joint": DEFAULT_JOINTS,
                },
                "limits": LIMITS,
            }
        )
        procedure = _ToPositions()
        orchestrator = Orchestrator(build_devices(settings), store, settings, kinds_with(procedure))
        try:
            yield orchestrator, store, procedure
        finally:
            orchestrator.shutdown()


def _stops(rng: Random, count: int) -> tuple[Stop, ...]:
    robot = Robot.default()
    places = [complex(rng.uniform(*robot.workspace_x), rng.uniform(*robot.workspace_y)) for _ in range(count)]
    angles = np.degrees(inverse(robot.geometry, np.array(places)))
    return tuple(
        Stop(f"p{n}", (place.real, place.imag), (float(first), float(second)))
        for n, (place, (first, second)) in enumerate(zip(places, angles, strict=True), start=1)
    )


def _wrong(readings: Iterable[Reading], tolerance_mm: float) -> list[str]:
    machine = Machine(MACHINE, VirtualClock())
    found = []
    for reading in readings:
        angles = zip(machine.axes, MACHINE.zero_at_deg, reading.theta_deg, strict=True)
        for axis, zero_deg, theta_deg in angles:
            axis.put((theta_deg - zero_deg) * MACHINE.pulses_per_deg)
        true_mm = machine.head_mm()
        found += [
            f"reading {reading.reading}: {value_mm:.4f} mm instead of {true_mm:.4f}"
            for value_mm in (reading.scale_mm, *reading.samples_mm)
            if abs(value_mm - true_mm) > tolerance_mm + 1e-6
        ]
    return found


def main() -> int:
    """0, or 1 if a wrong value was stored."""
    parser = argparse.ArgumentParser(prog="python -m tests.drivers.random_faults")
    parser.add_argument("--readings", type=int, default=10_000, help="of all rigs together")
    parser.add_argument("--rate", type=float, default=0.01, help="share of requests that are spoiled")
    parser.add_argument("--rig", help="only this one, as SERVO,SCALE,LINE")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rigs = [tuple(arguments.rig.split(","))] if arguments.rig else list(product(SERVOS, SCALES, LINES))
    wrong = 0
    for servo, scale, line in rigs:
        share = -(-arguments.readings // len(rigs))
        outcome = measured(servo, scale, line, share, arguments.rate, arguments.seed)
        print(f"{servo} {scale} {line}: {outcome.text}", flush=True)
        wrong += len(outcome.wrong)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
