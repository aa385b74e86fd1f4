"""Plans that need a person once: to read an angle, or to move the mechanism to its second mounting point."""

from __future__ import annotations

from typing import Literal

from station.plans import make_plan
from station.records import (
    Ask,
    Beforehand,
    JointAngle,
    MeasurementSequence,
    Procedure,
    Reading,
)
from station.run_kinds.kind import Start
from station.run_kinds.verified import identified_and_verified

JOINT: Literal[1] = 1


def reference(start: Start, memory: Beforehand | None) -> Procedure:
    """Six positions, then the angle of one arm from a level, at the arm's last position."""
    stops = make_plan("reference", start.robot).stops
    readings: list[Reading] = yield MeasurementSequence("Measuring", 1, stops)
    at_deg = readings[-1].theta_deg[JOINT - 1]
    reach_deg = 4.0 * start.robot.tolerances.zero_offset_deg
    seen_deg: float = yield Ask(
        "Reading the level",
        1,
        f"Put the level on the arm of joint {JOINT} and read its angle from the horizontal, positive when the"
        f" elbow is higher. The drive says {at_deg:.3f} deg.",
        "number",
        "deg",
        low=at_deg - reach_deg,
        high=at_deg + reach_deg,
    )
    seen = JointAngle(joint=JOINT, at_deg=at_deg, reads_deg=seen_deg, sd_deg=start.limits.level_sd_deg)
    return (
        yield from identified_and_verified(start.robot.informed([seen]), readings, memory, start.wanted_mm)
    )


def two_mounts(start: Start, memory: Beforehand | None) -> Procedure:
    """The same positions from two mounting points; each has a separate mounting error and offset.

    The second mounting point comes first: the mechanism is measured and verified last at the point where it
    remains mounted, so the mounting error that later runs use is that of the first mounting point.
    """
    robot = start.robot
    label, c = robot.second_mount
    stops = make_plan("two_mounts", robot).stops
    yield Ask(
        "Moving the mechanism",
        1,
        f"Mount the mechanism at its second mounting point, ({c[0]:g}, {c[1]:g}) mm, then confirm.",
        "confirm",
        mounted_at=c,
    )
    readings: list[Reading] = yield MeasurementSequence(
        "Measuring at the second mounting point", 1, stops, mount=label
    )
    yield Ask(
        "Moving the mechanism back",
        1,
        f"Mount the mechanism back at its first mounting point, ({robot.c[0]:g}, {robot.c[1]:g}) mm,"
        " then confirm.",
        "confirm",
        mounted_at=robot.c,
    )
    readings += yield MeasurementSequence("Measuring at the first mounting point", 1, stops)
    return (yield from identified_and_verified(robot, readings, memory, start.wanted_mm))
