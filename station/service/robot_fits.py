"""Whether a robot belongs to the drives of this station."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

from station.errors import InputRefused
from station.five_bar import Robot
from station.settings import JointSettings


def check_fits(robot: Robot, joints: Sequence[JointSettings]) -> None:
    """:raises InputRefused: a joint's scaling differs from its drive's; the error names the first."""
    for joint, settings in enumerate(joints, start=1):
        wanted, has = asdict(robot.scaling(joint)), asdict(settings.scaling)
        differing = [f"{key} {wanted[key]} instead of {has[key]}" for key in has if wanted[key] != has[key]]
        if differing:
            raise InputRefused(
                f"Robot {robot.serial} does not fit this station's drives: joint {joint} has"
                f" {', '.join(differing)}; correct its [joints] or the station's [[servo.joint]]."
            )
