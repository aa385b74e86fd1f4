"""Position of an axis during motion: piecewise constant acceleration."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Motion:
    """Starts at `start` with `speed` at t = 0 and runs through `phases` of (duration_s, acceleration)."""

    start: float
    speed: float
    phases: tuple[tuple[float, float], ...]
    end: float

    @cached_property
    def duration_s(self) -> float:
        return sum(duration_s for duration_s, _ in self.phases)

    @cached_property
    def top_speed(self) -> float:
        """The highest speed during the motion, never negative."""
        highest, speed = abs(self.speed), self.speed
        for duration_s, acceleration in self.phases:
            speed += acceleration * duration_s
            highest = max(highest, abs(speed))
        return highest

    def at(self, t_s: float) -> tuple[float, float]:
        """Position and speed at `t_s` after the start."""
        if t_s > self.duration_s:
            return self.end, 0.0
        position, speed = self.start, self.speed
        for duration_s, acceleration in self.phases:
            spent_s = min(t_s, duration_s)
            position += speed * spent_s + acceleration * spent_s**2 / 2
            speed += acceleration * spent_s
            t_s -= spent_s
            if t_s <= 0.0:
                return position, speed
        return self.end, 0.0


def standing(at: float) -> Motion:
    """No motion at all."""
    return Motion(at, 0.0, (), at)


def trapezoid(start: float, end: float, top_speed: float, acceleration: float) -> Motion:
    """From rest to rest; a triangle if the distance is too short for the top speed."""
    way = abs(end - start)
    signed = math.copysign(acceleration, end - start)
    ramp_s = min(top_speed / acceleration, math.sqrt(way / acceleration))
    cruise_s = (way - acceleration * ramp_s**2) / top_speed if way else 0.0
    return Motion(start, 0.0, ((ramp_s, signed), (max(0.0, cruise_s), 0.0), (ramp_s, -signed)), end)


def braking(start: float, speed: float, deceleration: float) -> Motion:
    """From `speed` to rest with `deceleration`."""
    duration_s = abs(speed) / deceleration
    end = start + speed * duration_s / 2
    return Motion(start, speed, ((duration_s, -math.copysign(deceleration, speed)),), end)
