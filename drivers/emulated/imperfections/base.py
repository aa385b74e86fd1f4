"""The interface of an effect with the machine: its actions and its inputs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import ClassVar, Literal

from pydantic import ConfigDict

from drivers.strict_numbers import StrictNumbers

JointNumber = Literal[1, 2]


@dataclass(slots=True)
class Scene:
    """The machine at one instant, computed from the motors to the head."""

    t_s: float
    """Time since the machine was switched on."""
    stop: int
    """Number of times it has come to rest."""
    direction: tuple[int, int]
    """Sign of each joint's last motion, 0 before the first."""
    travel_deg: tuple[float, float]
    """Angle by which each drive has turned its joint from the drive's zero, deg."""
    way_deg: tuple[float, float]
    """Length of each joint's last motion, deg, never negative."""
    top_deg_per_s: tuple[float, float]
    """The highest speed of each joint's last motion, deg/s of the machine's time, never negative."""
    rested_s: float
    """Time since both axes came to rest, s; 0 while one moves."""
    theta_deg: list[float]
    """The arms' angles, as far as they are computed, deg."""
    elbows_mm: tuple[tuple[float, float], tuple[float, float]] = ((0.0, 0.0), (0.0, 0.0))
    """The passive joints between L and l, once the arms are computed."""
    r_mm: tuple[float, float] = (0.0, 0.0)
    """P, once the arms are computed."""
    rho_mm: float = 0.0
    """Distance O_1 to O_2, once P and O_2 are computed."""
    travel_mm: float = 0.0
    """The slider's position on the scale: rho less the head's constant."""


@dataclass(slots=True)
class Lengths:
    """Links at this instant, mm; index 0 is joint 1's chain."""

    L: list[float]
    l: list[float]  # noqa: E741  the paper's symbol


class Effect(StrictNumbers):
    """An imperfection.  Each hook returns its contribution; an effect overrides the one where it acts.

    Effects with a memory (backlash) are called in the order of events, so the result may depend on earlier
    calls, but two calls in the same scene give the same result.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    stage: ClassVar[int] = 0
    """Joint effects act in this order: 0 encoder, 1 motor and gear, 2 backlash, 3 load on the arm."""
    follows_path: ClassVar[bool] = False
    """Whether it depends on the path between stops and not only on the stops."""

    def start(self, rng: Random) -> None:
        """Called once, when the machine is switched on."""

    def on_stop(self) -> None:
        """Called each time the machine comes to rest."""

    def on_joint_deg(self, joint: JointNumber, scene: Scene) -> float:
        """Added to the angle of an arm, deg."""
        return 0.0

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        """Changes the links, if it acts on them."""

    def on_base_mm(self, joint: JointNumber, scene: Scene) -> tuple[float, float]:
        """Shift of the joint's centre A_i from its nominal position, x and y, mm."""
        return 0.0, 0.0

    def on_mechanism_mm(self, scene: Scene) -> tuple[float, float]:
        """Shift of O_2 from P + d, less the shift of O_1, x and y, mm."""
        return 0.0, 0.0

    def on_head_mm(self, scene: Scene) -> float:
        """Added to the reading, mm."""
        return 0.0

    def temperature_rise_k(self, t_s: float) -> float:
        """Added to the temperature a thermometer on the machine shows."""
        return 0.0


class JointEffect(Effect):
    """An effect at one active joint."""

    joint: JointNumber

    def on_joint_deg(self, joint: JointNumber, scene: Scene) -> float:
        return self.at_joint_deg(scene) if joint == self.joint else 0.0

    def at_joint_deg(self, scene: Scene) -> float:
        """Added to the angle of this joint's arm, deg."""
        raise NotImplementedError

    def arm_deg(self, scene: Scene) -> float:
        """This joint's angle so far in the computation."""
        return scene.theta_deg[self.joint - 1]


@dataclass(slots=True)
class Play:
    """A part driven through backlash: it stays until its driver has crossed the width."""

    _follower: float | None = None

    def follow(self, driver: float, width: float) -> float:
        """Position of the follower less that of its driver; starts in the middle."""
        if self._follower is None:
            self._follower = driver
        self._follower = min(max(self._follower, driver - width / 2), driver + width / 2)
        return self._follower - driver


@dataclass(slots=True)
class LastStop:
    """Stores a value from one stop to the next."""

    _stop: int | None = None
    _here: float = 0.0
    _before: float | None = None

    def before(self, stop: int, value: float) -> float | None:
        """The value at the previous stop; `value` is the present one, None the result before the first."""
        if stop != self._stop:
            self._before = None if self._stop is None else self._here
            self._stop, self._here = stop, value
        return self._before


def turned(vector_mm: tuple[float, float], deg: float) -> tuple[float, float]:
    """Motion of the end of a vector when it turns by `deg` about its foot, mm."""
    x, y = vector_mm
    cosine, sine = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    return x * cosine - y * sine - x, x * sine + y * cosine - y
