"""Servo drives, one family per module."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from drivers.driver import ServoDriver
from drivers.servos import leadshine_cs2rs, leadshine_el7, orientalmotor_blvr
from drivers.servos.leadshine_el7 import LeadshineEL7
from drivers.servos.orientalmotor_blvr import OrientalMotorBLVR

SERVOS: Mapping[str, ServoDriver[Any]] = {
    "leadshine-cs2rs": leadshine_cs2rs.DRIVER,
    "leadshine-el7": leadshine_el7.DRIVER,
    "orientalmotor": orientalmotor_blvr.DRIVER,
}
"""Drivers by `[servo] profile` of the station file."""

__all__ = [
    "SERVOS",
    "LeadshineEL7",
    "OrientalMotorBLVR",
]
