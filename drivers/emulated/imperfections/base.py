"""What an effect may do to the machine, and what it can see of it."""

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
    """The machine at one instant, filled in from the motors towards the head."""

    t_s: float
    """Since the machine was switched on."""
    stop: int
    """How many times it has come to rest."""
    direction: tuple[int, int]
    """Sign of each joint's last motion, 0 before the first."""
    travel_deg: tuple[float, float]
    """What each drive has turned its joint from the drive's zero, deg."""
    way_deg: tuple[float, float]
    """How far each joint's last motion went, deg, never negative."""
    top_deg_per_s: tuple[float, float]
    """The highest speed of each joint's last motion, deg/s of the machine's time, never negative."""
    rested_s: float
    """How long both axes have stood still, s; 0 while one moves."""
    theta_deg: list[float]
    """The arms' angles as far as they are known, deg."""
    elbows_mm: tuple[tuple[float, float], tuple[float, float]] = ((0.0, 0.0), (0.0, 0.0))
    """The passive joints between L and l, once the arms are known."""
    r_mm: tuple[float, float] = (0.0, 0.0)
    """P, once the arms are known."""
    rho_mm: float = 0.0
    """Distance O_1 to O_2, once P and O_2 are known."""
    travel_mm: float = 0.0
    """The slider's place on the scale: rho less the head's constant."""


@dataclass(slots=True)
class Lengths:
    """Links as they are at this instant, mm; index 0 is joint 1's chain."""

    L: list[float]
    l: list[float]  # noqa: E741  the paper's symbol


class Effect(StrictNumbers):
    """An imperfection.  Each hook answers what it adds; an effect overrides the one where it acts.

    Effects with a memory (play) are asked in the order in which things happen, so the answer may
    depend on earlier questions, but asking twice in the same scene gives the same answer.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    stage: ClassVar[int] = 0
    """Joint effects act in this order: 0 encoder, 1 motor and gear, 2 play, 3 load on the arm."""
    follows_path: ClassVar[bool] = False
    """Whether it depends on the way between stops and not on the stops alone."""

    def start(self, rng: Random) -> None:
        """Called once, when the machine is switched on."""

    def on_stop(self) -> None:
        """Called each time the machine comes to rest."""

    def on_joint_deg(self, joint: JointNumber, scene: Scene) -> float:
        """Added to the angle of an arm, deg."""
        return 0.0

    def on_lengths(self, lengths: Lengths, scene: Scene) -> None:
        """May change the links."""

    def on_base_mm(self, joint: JointNumber, scene: Scene) -> tuple[float, float]:
        """Shift of the joint's centre A_i beside its place, x and y, mm."""
        return 0.0, 0.0

    def on_mechanism_mm(self, scene: Scene) -> tuple[float, float]:
        """Shift of O_2 beside P + d, less the shift of O_1, x and y, mm."""
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
        """This joint's angle so far."""
        return scene.theta_deg[self.joint - 1]


@dataclass(slots=True)
class Play:
    """What is dragged along with a play: it stays until its driver has crossed the width."""

    _follower: float | None = None

    def follow(self, driver: float, width: float) -> float:
        """Where the follower is, less where its driver is; starts in the middle."""
        if self._follower is None:
            self._follower = driver
        self._follower = min(max(self._follower, driver - width / 2), driver + width / 2)
        return self._follower - driver


@dataclass(slots=True)
class LastStop:
    """Remembers a value from one stop to the next."""

    _stop: int | None = None
    _here: float = 0.0
    _before: float | None = None

    def before(self, stop: int, value: float) -> float | None:
        """The value at the stop before this one; `value` is the present one, None is the answer at first."""
        if stop != self._stop:
            self._before = None if self._stop is None else self._here
            self._stop, self._here = stop, value
        return self._before


def turned(vector_mm: tuple[float, float], deg: float) -> tuple[float, float]:
    """How far the end of a vector moves when it turns by `deg` about its foot, mm."""
    x, y = vector_mm
    cosine, sine = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    return x * cosine - y * sine - x, x * sine + y * cosine - y
