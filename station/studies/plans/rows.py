"""One machine of each row of the page: what was promised, what came of it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from station.five_bar import FiveBar, Robot
from station.identification import Identification, bounds_mm, identify
from station.plans import USUAL
from station.records import AnyReference, JointAngle, MountingError, PlanName, Remembered
from station.run_kinds import adaptive_run, check_run, fit_in_sequence
from station.studies.drawn import Drawn, drawn, robot_of, stops_of
from station.studies.plans.walked import walk
from station.studies.simulation import SAMPLES

LEVEL_SD_DEG, MOUNTING_SD_MM = 0.005, 0.02
REMOUNT_MM, LINK_MM = 1.0, 0.3
TOMORROW = datetime(2030, 1, 1, tzinfo=UTC)
WISH = 1.01
"""Of the bound that the full run before reached."""
CASES: dict[str, tuple[PlanName, bool, bool]] = {
    "full": ("full", False, False),
    "full, joint 1 seen": ("full", True, False),
    "six readings, joint 1 seen": ("rapid", True, False),
    "full, rMx measured": ("full", False, True),
    "full, both": ("full", True, True),
}
"""Plan, whether an angle is seen, whether the mounting is measured."""


@dataclass(frozen=True)
class Kept:
    """A promise and the machine that it was made of, mm."""

    largest_mm: float
    bound_mm: float
    by_model_mm: float
    bound_by_model_mm: float


@dataclass(frozen=True)
class Struck:
    """A run of plan `adaptive` after a collision, and one whose memory was wrong."""

    readings: int
    machine_s: float
    memory_used: bool
    reached: bool
    kept: Kept
    change: str
    """What was wrong with the memory of the second."""
    let_through: bool


@dataclass(frozen=True)
class Checked:
    """Two checks: of a machine that did not change, and of one that shifted by the smallest size stated."""

    smallest_deg: float
    false_alarm: bool
    found: bool


def calibrated(item: tuple[float, int]) -> dict[str, Kept]:
    """Every case on one machine: (tolerance, seed)."""
    robot, machine, rng = _machine(item)
    references: tuple[AnyReference, AnyReference] = (
        JointAngle(
            joint=1,
            at_deg=0.0,
            reads_deg=float(np.degrees(machine.truth[0]) + rng.normal(0.0, LEVEL_SD_DEG)),
            sd_deg=LEVEL_SD_DEG,
        ),
        MountingError(
            kind="drm_x",
            value_mm=float(machine.truth[10] + rng.normal(0.0, MOUNTING_SD_MM)),
            sd_mm=MOUNTING_SD_MM,
        ),
    )
    readings = {
        plan: machine.machine(number).run(stops_of(plan, item[0]), SAMPLES)
        for number, plan in enumerate(("full", "rapid"))
    }
    out = {}
    for name, (plan, *given) in CASES.items():
        known = robot.informed([r for r, use in zip(references, given, strict=True) if use])
        out[name] = _kept(machine, identify(known, readings[plan]))
    return out


def struck(item: tuple[float, int]) -> Struck:
    """A full run, a collision, plan `adaptive`; and once more with a memory that is wrong."""
    robot, machine, rng = _machine(item)
    before = identify(robot, machine.machine().run(stops_of("full", item[0]), SAMPLES))
    memory = Remembered(1, datetime.now(UTC), before.lasting.record())
    wish_mm = WISH * bounds_mm(before)[0]
    after = machine.struck(rng)
    run = walk(adaptive_run(robot, memory, wish_mm, USUAL), after.machine(1))
    used = run.result.memory is not None and run.result.memory.used
    fit = fit_in_sequence(robot, list(run.readings), memory if used else None, 0.0)
    change, truth = "link", after.truth.copy()
    if item[1] % 2:
        turn = rng.uniform(0.0, 2.0 * np.pi)
        truth[10:] += REMOUNT_MM * np.array([np.cos(turn), np.sin(turn)])
        change = f"mounted anew, {np.degrees(turn):.0f} deg"
    else:
        link = int(rng.integers(4))
        truth[6 + link] += LINK_MM * rng.choice([-1.0, 1.0])
        change = ("L1", "L2", "l1", "l2")[link]
    misled = walk(adaptive_run(robot, memory, wish_mm, USUAL), Drawn(robot, truth, item[1]).machine(2)).result
    return Struck(
        readings=len(run.readings),
        machine_s=run.machine_s,
        memory_used=used,
        reached=bool(run.result.accuracy and run.result.accuracy.reached),
        kept=_kept(after, fit),
        change=change,
        let_through=misled.verdict == "pass" and misled.memory is not None and misled.memory.used,
    )


def checked(item: tuple[float, int]) -> Checked:
    """A full run, then plan `check` twice."""
    robot, machine, rng = _machine(item)
    fit = identify(robot, machine.machine().run(stops_of("full", item[0]), SAMPLES))
    still = walk(check_run(fit, 0.0, TOMORROW), machine.machine(1)).result
    assert still.check is not None
    joint = int(rng.integers(2))
    truth = machine.truth.copy()
    truth[joint] += np.radians(still.check.smallest_by_joint_deg[joint]) * rng.choice([-1.0, 1.0])
    shifted = walk(check_run(fit, 0.0, TOMORROW), Drawn(robot, truth, item[1]).machine(2)).result
    return Checked(still.check.smallest_shift_deg, still.verdict == "fail", shifted.verdict == "fail")


def _machine(item: tuple[float, int]) -> tuple[Robot, Drawn, np.random.Generator]:
    robot = robot_of(item[0])
    return robot, *drawn(robot, item[1])


def _kept(machine: Drawn, fit: Identification[FiveBar]) -> Kept:
    largest, by_model = machine.largest_errors_mm(fit)
    bound, bound_by_model = bounds_mm(fit)
    return Kept(largest, bound, by_model, bound_by_model)
