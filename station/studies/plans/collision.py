"""Plan `adaptive` after a collision: with a right memory, and with one that is wrong."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from station.five_bar import FiveBar
from station.identification import Identification, Known, bounds_mm, identify
from station.plans import USUAL, full_positions
from station.records import Real, Remembered
from station.run_kinds import adaptive_run, fit_in_sequence, memory_test
from station.studies.drawn import Drawn, drawn, robot_of
from station.studies.plans.promise import Kept, kept
from station.studies.plans.references import measured
from station.studies.walked import walk

REMOUNT_MM, LINK_MM = 1.0, 0.3
WISH = 1.01
"""Of the bound that the full run before reached."""
CLEAR_SDS = 5.0
FULL_VISITS = 5


@dataclass(frozen=True)
class Struck:
    """A run of plan `adaptive` after a collision."""

    readings: int
    machine_s: float
    memory_used: bool
    reached: bool
    kept: Kept


@dataclass(frozen=True)
class Misled:
    """The same with a memory that is wrong."""

    change: str
    seen_sds: float
    """How clearly a full run would see it, in standard deviations."""
    let_through: bool


def struck(item: tuple[float, int]) -> Struck:
    """A full run, a collision, plan `adaptive`: (tolerance, seed)."""
    machine, rng, before = _calibrated(item)
    memory = Remembered(1, datetime.now(UTC), before.lasting.record())
    after = machine.struck(rng)
    run = walk(adaptive_run(machine.robot, memory, WISH * bounds_mm(before)[0], USUAL), after.machine(1))
    used = run.result.memory is not None and run.result.memory.used
    fit = fit_in_sequence(machine.robot, list(run.readings), memory if used else None, 0.0)
    return Struck(
        readings=len(run.readings),
        machine_s=run.machine_s,
        memory_used=used,
        reached=bool(run.result.accuracy and run.result.accuracy.reached),
        kept=kept(after, fit),
    )


def misled(item: tuple[float, int]) -> Misled:
    """A full run, a collision that changed geometry or mounting too, plan `adaptive`: (tolerance, seed)."""
    machine, rng, before = _calibrated(item)
    memory = Remembered(1, datetime.now(UTC), before.lasting.record())
    truth = machine.struck(rng).truth
    change = np.zeros(len(truth))
    if item[1] % 2:
        turn = rng.uniform(0.0, 2.0 * np.pi)
        change[10:] = REMOUNT_MM * np.array([np.cos(turn), np.sin(turn)])
        what = f"mounted anew, {np.degrees(turn):.0f} deg"
    else:
        link = int(rng.integers(4))
        change[6 + link] = LINK_MM * rng.choice([-1.0, 1.0])
        what = ("L1", "L2", "l1", "l2")[link]
    wrong = Drawn(machine.robot, truth + change, item[1]).machine(2)
    run = walk(adaptive_run(machine.robot, memory, WISH * bounds_mm(before)[0], USUAL), wrong).result
    used = run.memory is not None and run.memory.used
    return Misled(what, _seen_sds(before, change), run.verdict == "pass" and used)


def _calibrated(item: tuple[float, int]) -> tuple[Drawn, np.random.Generator, Identification[FiveBar]]:
    machine, rng = drawn(robot_of(item[0]), item[1])
    return machine, rng, identify(machine.robot, measured(machine, "full", rng))


def _seen_sds(before: Identification[FiveBar], change: Real) -> float:
    """By the readings of a full run, of a change (12,) of what the memory holds."""
    known = Known(before.mechanism.robot, memory=before.lasting)
    test, names = memory_test(known)
    rows = np.repeat(known.rows(full_positions(known.robot)), FULL_VISITS, axis=0)
    order = [p.name for p in known.parameters]
    of_names = change[[order.index(name) for name in names]]
    return float(np.sqrt(test.noncentrality(rows.T @ rows, of_names[None])[0]))
