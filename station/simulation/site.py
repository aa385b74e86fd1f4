"""The variable equipment of a station: devices, lines, speeds of motion and computation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Literal

from drivers.emulated.blvr import BLVRDrive
from drivers.emulated.drive import EmulatedDrive
from drivers.emulated.el7 import EL7, EL7Drive
from drivers.emulated.faults import Faults
from drivers.emulated.machine import Machine
from drivers.emulated.nd280 import ND280
from drivers.emulated.readout import EmulatedReadout
from drivers.emulated.siko_head import SikoDevice
from drivers.emulated.spec import MachineSpec

SERVO_PORT, SERVO_BAUD = "/dev/servo", 38_400
SCALE_BAUD = {"heidenhain-nd": 9600, "siko": 19_200}
_SCALE_FORMAT = {"heidenhain-nd": "7E2", "siko": "8N1"}
_SIKO_MM = 0.01
_WATCHDOG_MS = 2000
"""Watchdog of the BLV-R; a drive behind a slow gateway is fed less often than one on its own line."""


@dataclass(frozen=True, slots=True)
class Site:
    """One station's equipment."""

    servo: Literal["leadshine-el7", "orientalmotor"] = "leadshine-el7"
    scale: Literal["heidenhain-nd", "siko"] = "heidenhain-nd"
    line: Literal["tcp", "rtu"] = "tcp"
    """A gateway, or one RS-485 line for both drives."""
    trip_s: float = 0.025
    """Time of a request and its reply through the gateway."""
    computing_s: float = 0.5
    """Time of an identification on the station's computer."""
    speed_deg_s: float = 30.0
    samples: int = 5
    """Number of samples of a reading."""
    haste: float = 1.0
    """Speed of the arms over real ones."""

    @classmethod
    def drawn(cls, random: Random) -> Site:
        """A random site of a typical plant: mostly the first family behind a gateway."""
        return cls(
            servo="orientalmotor" if random.random() < 0.15 else "leadshine-el7",
            scale="siko" if random.random() < 0.3 else "heidenhain-nd",
            line="rtu" if random.random() < 0.15 else "tcp",
            trip_s=random.choice((0.01, 0.03, 0.06)),
            computing_s=random.choice((0.1, 1.0, 3.0)),
            speed_deg_s=random.choice((30.0, 60.0, 120.0)),
            samples=random.choice((2, 3, 5)),
        )

    @classmethod
    def instant(cls) -> Site:
        """Devices that answer and arrive almost at once, for thousands of cases."""
        return cls(trip_s=0.001, computing_s=0.01, speed_deg_s=120.0, samples=2, haste=50.0)

    @property
    def settings(self) -> dict[str, object]:
        """Settings in its station file."""
        scale: dict[str, object] = {
            "protocol": self.scale,
            "url": f"serial:///dev/scale?baud={SCALE_BAUD[self.scale]}&format={_SCALE_FORMAT[self.scale]}",
        }
        if self.scale == "siko":
            scale["resolution_mm"] = _SIKO_MM
        rtu = f"modbus+rtu://{SERVO_PORT}?baud={SERVO_BAUD}&format=8N2"
        servo: dict[str, object] = {
            "profile": self.servo,
            "url": rtu if self.line == "rtu" else "modbus+tcp://10.0.0.2:502",
        }
        if self.servo == "orientalmotor":
            servo["watchdog_ms"] = _WATCHDOG_MS
        return {
            "name": "Simulated station",
            "scale": scale,
            "servo": servo,
            "limits": {"speed_deg_s": self.speed_deg_s, "samples": self.samples},
        }

    def readout(self, machine: Machine, faults: Faults, clock: Callable[[], float]) -> EmulatedReadout:
        """The device named in the settings."""
        if self.scale == "siko":
            return SikoDevice(machine.head_mm, faults, _SIKO_MM, clock)
        return ND280(machine.head_mm, faults)

    def drive(self, machine: Machine, joint: int, faults: Faults) -> EmulatedDrive:
        """The drive of one joint."""
        if self.servo == "orientalmotor":
            return BLVRDrive(machine, joint, faults, MachineSpec().counts_per_rev)
        return EL7Drive(machine, joint, faults, EL7)
