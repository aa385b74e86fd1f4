"""In-process devices that carry out commands at once, and fail where a test requests it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from threading import Event

import numpy as np

from drivers.errors import DeviceError, LinkLost
from drivers.protocols import AxisStatus
from station.five_bar.kinematics import forward, inverse
from station.five_bar.robot_file import Robot
from station.motion.devices import Devices
from station.records import (
    CalibrationResult,
    MeasurementSequence,
    PlanName,
    Procedure,
    Quantity,
    Reading,
    Stop,
    because,
)
from tests.station.asking import result

GEOMETRY = Robot.default().geometry
HOME_DEG = (0.0, 180.0)


AXIS_CALLS = (
    "connect", "make_safe", "close", "enable", "move_to", "status", "feedback", "reset_alarm", "quick_stop",
    "preset",
)  # fmt: skip
CALLS = {
    *(f"axis {number} {call}" for number in (1, 2) for call in AXIS_CALLS),
    *(f"scale {call}" for call in ("connect", "make_safe", "close", "read")),
}


@dataclass
class Script:
    """Scripted faults: for one of `CALLS`, from the n-th time on, do this."""

    faults: dict[str, tuple[int, Callable[[], None]]] = field(default_factory=dict)
    calls: list[str] = field(default_factory=list)

    def fail(self, call: str, error: Exception, *, at: int = 1) -> None:
        """Raise from the `at`-th call on."""

        def fault() -> None:
            raise error

        self.do(call, fault, at=at)

    def do(self, call: str, action: Callable[[], None], *, at: int = 1) -> None:
        """Act from the `at`-th call on.  :raises ValueError: no fake makes this call"""
        if call not in CALLS:
            raise ValueError(f"no device makes the call {call!r}; use one of {', '.join(sorted(CALLS))}")
        self.faults[call] = (at, action)

    def happens(self, call: str) -> None:
        assert call in CALLS, call
        self.calls.append(call)
        at, action = self.faults.get(call, (0, None))
        if action is not None and self.calls.count(call) >= at:
            action()


class FakeAxis:
    """A drive without inertia: it is at its target at once, unless told to keep moving."""

    def __init__(self, number: int, script: Script) -> None:
        self.name = f"axis {number}"
        self.theta_deg = HOME_DEG[number - 1]
        self.offset_deg = 0.0
        """Actual less nominal joint angle."""
        self.stands_off_deg = 0.0
        """Deviation from its command at rest."""
        self.enabled = False
        self.alarm: int | None = None
        self.alarm_resettable = True
        self.stuck = False
        self.moving = False
        self._script = script

        self._connected = False

    def _happens(self, what: str) -> None:
        self._script.happens(f"{self.name} {what}")
        if not self._connected and what not in ("connect", "make_safe", "close"):
            raise LinkLost(f"{self.name} is not connected")

    def connect(self) -> None:
        self._happens("connect")
        self._connected = True

    def make_safe(self) -> None:
        self._happens("make_safe")

    def close(self) -> None:
        self._connected = False
        self._happens("close")

    def enable(self) -> None:
        self._happens("enable")
        self.enabled = True

    def move_to(self, theta_deg: float, speed_deg_s: float) -> None:
        self._happens("move_to")
        assert speed_deg_s > 0
        if self.stuck:
            self.moving = True
        else:
            self.theta_deg = theta_deg + self.stands_off_deg

    def status(self) -> AxisStatus:
        self._happens("status")
        return AxisStatus(self.enabled, self.moving, not self.moving, self.alarm)

    def feedback_deg(self) -> float:
        self._happens("feedback")
        return self.theta_deg

    def reset_alarm(self) -> None:
        self._happens("reset_alarm")
        if not self.alarm_resettable:
            raise DeviceError(f"{self.name} keeps alarm {self.alarm:X}h")
        self.alarm = None

    def quick_stop(self) -> None:
        self._happens("quick_stop")
        self.moving = False

    def preset(self, theta_deg: float) -> None:
        self._happens("preset")
        self.offset_deg += self.theta_deg - theta_deg
        self.theta_deg = theta_deg


class FakeScale:
    """Reads the distance from the axes, minus a constant."""

    def __init__(self, axes: Sequence[FakeAxis], script: Script) -> None:
        self.name = "scale"
        self.offset_mm = 500.0
        self.noise_mm: Callable[[], float] = lambda: 0.0
        self._axes = axes
        self._script = script

    def connect(self) -> None:
        self._script.happens("scale connect")

    def make_safe(self) -> None:
        self._script.happens("scale make_safe")

    def close(self) -> None:
        self._script.happens("scale close")

    def read_mm(self) -> float:
        self._script.happens("scale read")
        theta = np.radians([[axis.theta_deg + axis.offset_deg for axis in self._axes]])
        return float(abs(forward(GEOMETRY, theta)[0] - GEOMETRY.cd)) - self.offset_mm + self.noise_mm()


@dataclass
class Rig:
    """Fake devices and the script of their faults."""

    script: Script
    axes: tuple[FakeAxis, FakeAxis]
    scale: FakeScale
    devices: Devices
    released: Event = field(default_factory=Event)
    """Set at the end of the test: hanging calls wait for it."""


def make_rig() -> Rig:
    script = Script()
    axes = (FakeAxis(1, script), FakeAxis(2, script))
    scale = FakeScale(axes, script)
    devices = Devices(scale, axes, ("fake://scale", "fake://1", "fake://2"), emulated=True, speed=1000.0)
    return Rig(script, axes, scale, devices)


def stop_at(position: str, x: float, y: float, approach: tuple[int, int] = (0, 0)) -> Stop:
    theta = np.degrees(inverse(GEOMETRY, np.array([complex(x, y)])))[0]
    return Stop(position, (x, y), (float(theta[0]), float(theta[1])), approach)


def stop_with(position: str, theta_deg: tuple[float, float], approach: tuple[int, int] = (0, 0)) -> Stop:
    P = complex(forward(GEOMETRY, np.radians([theta_deg]))[0])
    return Stop(position, (P.real, P.imag), theta_deg, approach)


STOPS = (
    stop_at("p1", -200.0, -640.0),
    stop_at("p2", 0.0, -640.0, (1, -1)),
    stop_at("p3", 200.0, -700.0, (-1, 1)),
)


def result_of(readings: Sequence[Reading], verdict: str = "pass") -> CalibrationResult:
    passed = verdict == "pass"
    return result(
        verdict=verdict,
        outcome="good" if passed else "failed",
        reason=because("converged", passes=2, mu_deg=0.01)
        if passed
        else because("mu_too_large", limit_deg=0.1, passes=8),
        method="fake",
        zero_offsets=(Quantity("dtheta1", 0.5, 0.1, "deg"), Quantity("dtheta2", -0.5, 0.1, "deg")),
        weak_direction={"text": "both arms together"},
        before={"reading_rms_mm": 3.0},
        after={"reading_rms_mm": 0.01},
        iterations=[{"pass": 1, "mu_deg": None}, {"pass": 2, "mu_deg": 0.01}],
        residuals=[
            {"reading": r.reading, "position": r.position, "residual_mm": 0.001, "limit_mm": 0.01}
            for r in readings
        ],
    )


def two_sequences(plan: PlanName, robot: Robot) -> Procedure:
    """Two passes over three stops."""
    readings = yield MeasurementSequence("Measuring, pass 1", 1, STOPS)
    readings = yield MeasurementSequence("Measuring, pass 2", 2, STOPS)
    return result_of(readings)
