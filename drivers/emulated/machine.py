"""The physical machine: two motors, gears, arms and links, a slider and a scale head.

It computes forward, from the motors' pulses to the head's reading, and shares no formula with the station's
identification.  It receives its clock as an argument, so a sequence of hundreds of stops can be simulated in
virtual time.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from random import Random
from threading import RLock
from typing import Literal

from drivers.emulated.imperfections.base import Effect, JointNumber, Lengths, Scene
from drivers.emulated.motion import Motion, braking, standing, trapezoid
from drivers.emulated.spec import MachineSpec

Clock = Callable[[], float]
Point = tuple[float, float]

_JOINTS: tuple[JointNumber, JointNumber] = (1, 2)
_STOP_RPM_PER_S = 50_000.0
_USUAL_RPM_PER_S = 10_000.0
_PATH_STEPS = 16
_REMOUNT_SD_MM = 0.2


class Unreachable(ValueError):
    """The links cannot meet with the arms at these angles."""


class Axis:
    """Motor, encoder and servo loop of one joint, in pulses counted from the drive's first zero."""

    def __init__(
        self, spec: MachineSpec, index: Literal[0, 1], clock: Clock, speed: float, rng: Random
    ) -> None:
        self._counts_per_rev = spec.counts_per_rev
        self._scatter_pulses = spec.servo_error_pulses / 3 if spec.scatter else 0.0
        self._whole_pulses = spec.whole_pulses
        self._zero_at_deg = spec.zero_at_deg[index]
        self._deg_per_pulse = spec.sign[index] / spec.pulses_per_deg
        self._offset_deg = spec.zero_offsets_deg[index]
        self._sign = spec.sign[index]
        self._clock = clock
        self._speed = speed
        self._rng = rng
        self._motion: Motion = standing(0.0)
        self._started_s = clock()
        self._commanded: int | None = None
        self.zero_pulses = 0
        """Position declared as the drive's zero."""
        self.direction = 0
        """Sign of the joint angle's last motion, 0 before the first."""
        self.way_deg = 0.0
        """Length of that motion, deg, never negative."""
        self.top_deg_per_s = 0.0
        """Its highest speed, deg/s of the machine's time, never negative."""

    def command(self, pulses: int, rpm: float, rpm_per_s: float = _USUAL_RPM_PER_S) -> None:
        """Start a move to `pulses` from the drive's zero; the servo comes to rest near it."""
        if pulses == self._commanded and not self.moving:
            return
        per_rpm = self._counts_per_rev / 60
        start, _ = self._at(self._clock())
        end = pulses + self.zero_pulses + self._rng.gauss(0.0, self._scatter_pulses)
        if self._whole_pulses:
            end = round(end)
        self._begin(trapezoid(start, end, rpm * per_rpm, rpm_per_s * per_rpm))
        self._commanded = pulses

    def quick_stop(self) -> None:
        """Brake hard from the current motion."""
        position, pulses_per_s = self._at(self._clock())
        if pulses_per_s:
            self._begin(braking(position, pulses_per_s, _STOP_RPM_PER_S * self._counts_per_rev / 60))
        self._commanded = None

    def declare_zero(self) -> None:
        """The present position becomes the drive's zero."""
        self.zero_pulses += self.feedback_pulses()
        self._commanded = None

    def put(self, pulses: float) -> None:
        """Set the position to `pulses` from the first zero, as after switching on."""
        self._motion = standing(pulses)
        self._commanded = None

    @property
    def moving(self) -> bool:
        return self._clock() < self.rests_from_s

    @property
    def rests_from_s(self) -> float:
        """The clock's time at which the present motion ends (or ended)."""
        return self._started_s + self._motion.duration_s / self._speed

    @property
    def shaft_pulses(self) -> float:
        """Position of the motor, from the first zero."""
        return self._at(self._clock())[0]

    def feedback_pulses(self) -> int:
        """Count of the encoder, from the drive's zero."""
        return round(self.shaft_pulses) - self.zero_pulses

    def travel_deg(self, at_s: float) -> float:
        """Joint travel from the first zero at a time of the clock."""
        return self._at(at_s)[0] * self._deg_per_pulse

    def arm_deg(self, at_s: float) -> float:
        """The arm's angle, zero offset included, before any other imperfection."""
        return self._zero_at_deg + self._offset_deg + self.travel_deg(at_s)

    @property
    def zero_offset_deg(self) -> float:
        """True zero offset of the drive in its present frame: actual less nominal angle."""
        return self._offset_deg + self.zero_pulses * self._deg_per_pulse

    def _begin(self, motion: Motion) -> None:
        self._motion = motion
        self._started_s = self._clock()
        if motion.end != motion.start:
            self.direction = self._sign * (1 if motion.end > motion.start else -1)
            self.way_deg = abs((motion.end - motion.start) * self._deg_per_pulse)
            self.top_deg_per_s = motion.top_speed * abs(self._deg_per_pulse)

    def _at(self, at_s: float) -> tuple[float, float]:
        """Position and speed, pulses and pulses per second of the machine's time."""
        return self._motion.at((at_s - self._started_s) * self._speed)


@dataclass(frozen=True, slots=True)
class MachineState:
    """The state that is retained without power."""

    shaft_pulses: tuple[float, float]
    zero_pulses: tuple[int, int]


class Machine:
    """The whole machine; may be used from any thread."""

    def __init__(
        self, spec: MachineSpec, clock: Clock = time.monotonic, *, seed: int | None = None, speed: float = 1.0
    ) -> None:
        """:param clock: seconds; only differences count

        :param seed: seed of all its random numbers; by default that of the spec
        :param speed: speed of the arms over real time
        """
        seed = spec.seed if seed is None else seed
        self._spec = self._mounted = spec
        # links and centres A_1 and A_2 at rest and cold
        self._L_mm = [length + error for length, error in zip(spec.L_mm, spec.L_error_mm, strict=True)]
        self._l_mm = [length + error for length, error in zip(spec.l_mm, spec.l_error_mm, strict=True)]
        x1, y1, x2, y2 = spec.e_error_mm
        self._centres_mm = _sum((spec.e_mm[0], (x1, y1))), _sum((spec.e_mm[1], (x2, y2)))
        self._clock = clock
        self._noise = Random(f"{seed} scale")
        self._lock = RLock()
        self.axes = (
            Axis(spec, 0, clock, speed, Random(f"{seed} servo 1")),
            Axis(spec, 1, clock, speed, Random(f"{seed} servo 2")),
        )
        self._seed = seed
        self._take(spec.effects)
        self._on_s = self._looked_s = clock()
        self._rested = True
        self._commanded_s = -math.inf
        self._stops = 0
        self._start_memories()

    # -- actions of the drives -----------------------------------------------------------------

    def command(
        self, joint: JointNumber, pulses: int, rpm: float, rpm_per_s: float = _USUAL_RPM_PER_S
    ) -> None:
        """Start a move of one joint, see `Axis.command`."""
        with self._lock:
            self._look()
            self.axes[joint - 1].command(pulses, rpm, rpm_per_s)
            self._rested = False
            self._commanded_s = self._clock()

    def quick_stop(self, joint: JointNumber) -> None:
        with self._lock:
            self._look()
            self.axes[joint - 1].quick_stop()

    def declare_zero(self, joint: JointNumber) -> None:
        with self._lock:
            self.axes[joint - 1].declare_zero()

    # -- measurements --------------------------------------------------------------------------

    def head_mm(self) -> float:
        """One reading of the scale head, with its noise.

        :raises Unreachable: the links cannot meet with the arms at these angles
        """
        with self._lock:
            self._look()
            scene = self._scene(self._clock())
            return self._reading_mm(scene) + self._noise.gauss(0.0, self._spec.scale_noise_mm)

    def point_mm(self) -> Point:
        """True position of P, as a tracker measures it."""
        with self._lock:
            self._look()
            return self._scene(self._clock()).r_mm

    def arms_deg(self) -> tuple[float, float]:
        """True angles of the proximal links, as a level on each shows them."""
        with self._lock:
            self._look()
            first, second = self._scene(self._clock()).theta_deg
            return first, second

    def temperature_rise_k(self) -> float:
        """Rise since switching on, as a thermometer on the machine shows it."""
        t_s = self._clock() - self._on_s
        return sum(effect.temperature_rise_k(t_s) for effect in self._effects)

    @property
    def rests_from_s(self) -> float:
        """The clock's time from which both axes are at standstill."""
        return max(axis.rests_from_s for axis in self.axes)

    @property
    def commanded_s(self) -> float:
        """The clock's time of the last motion that was begun; before the first, minus infinity."""
        return self._commanded_s

    # -- power off and on ----------------------------------------------------------------------

    def state(self) -> MachineState:
        with self._lock:
            first, second = self.axes
            return MachineState(
                (first.shaft_pulses, second.shaft_pulses), (first.zero_pulses, second.zero_pulses)
            )

    def restore(self, state: MachineState) -> None:
        """Set the stored state of the machine."""
        with self._lock:
            for axis, shaft, zero in zip(self.axes, state.shaft_pulses, state.zero_pulses, strict=True):
                axis.put(shaft)
                axis.zero_pulses = zero
            self._start_memories()

    def remount(self, c_mm: Point, mounting: int = 0) -> None:
        """Mount the mechanism there; every point, and every mounting from 1 on, has its own constant
        error.
        """
        with self._lock:
            own = Random(f"{self._seed} mount {c_mm}" + (f" {mounting}" if mounting else ""))
            error = self._mounted.drm_mm
            if mounting or c_mm != self._mounted.c_mm:
                error = (own.gauss(error[0], _REMOUNT_SD_MM), own.gauss(error[1], _REMOUNT_SD_MM))
            self._spec = self._mounted.model_copy(update={"c_mm": c_mm, "drm_mm": error})

    # -- effects on order ----------------------------------------------------------------------

    def replace_effects(self, effects: Sequence[Effect]) -> None:
        """Activate these effects and no others; for them the machine was switched on at this moment."""
        with self._lock:
            self._look()
            self._on_s, self._stops = self._clock(), 0
            self._take(effects)
            self._start_memories()

    def _take(self, effects: Sequence[Effect]) -> None:
        self._effects = [_fresh(effect) for effect in effects]
        self._joint_effects = sorted(self._effects, key=lambda effect: effect.stage)
        self._steps = 1 if self._effects else 0
        if any(effect.follows_path for effect in self._effects):
            self._steps = _PATH_STEPS
        for number, effect in enumerate(self._effects):
            effect.start(Random(f"{self._seed} effect {number}"))

    def _start_memories(self) -> None:
        """Initialise effects with a memory with the state before the first motion."""
        with suppress(Unreachable):
            self._reading_mm(self._scene(self._clock()))

    # -- physics ---------------------------------------------------------------------------------

    def _look(self) -> None:
        """Update effects with a memory with the events since the last call."""
        now_s = self._clock()
        if not self._rested:
            rests_s = self.rests_from_s
            until_s = min(now_s, rests_s)
            steps = self._steps if until_s > self._looked_s else 0
            for step in range(1, steps + 1):
                at_s = self._looked_s + (until_s - self._looked_s) * step / steps
                with suppress(Unreachable):  # the head is off the scale; no part follows the arms there
                    self._reading_mm(self._scene(at_s))
            if now_s >= rests_s and now_s > self._commanded_s:  # the other joint's command may still follow
                self._rested = True
                self._stops += 1
                for effect in self._effects:
                    effect.on_stop()
        self._looked_s = now_s

    def _scene(self, at_s: float) -> Scene:
        first, second = self.axes
        scene = Scene(
            t_s=at_s - self._on_s,
            stop=self._stops,
            direction=(first.direction, second.direction),
            travel_deg=(first.travel_deg(at_s), second.travel_deg(at_s)),
            way_deg=(first.way_deg, second.way_deg),
            top_deg_per_s=(first.top_deg_per_s, second.top_deg_per_s),
            rested_s=max(0.0, at_s - self.rests_from_s),
            theta_deg=[first.arm_deg(at_s), second.arm_deg(at_s)],
        )
        for effect in self._joint_effects:
            for joint in _JOINTS:
                scene.theta_deg[joint - 1] += effect.on_joint_deg(joint, scene)
        spec = self._spec
        lengths = Lengths(list(self._L_mm), list(self._l_mm))
        centres = self._centres_mm
        self._place(scene, lengths, centres)
        if self._effects:
            for effect in self._effects:
                effect.on_lengths(lengths, scene)
            shifts = [_sum(effect.on_base_mm(joint, scene) for effect in self._effects) for joint in _JOINTS]
            self._place(scene, lengths, (_sum((centres[0], shifts[0])), _sum((centres[1], shifts[1]))))
        foot = (
            spec.c_mm[0] + spec.d_mm[0] + spec.drm_mm[0],
            spec.c_mm[1] + spec.d_mm[1] + spec.drm_mm[1],
        )
        head = _sum((scene.r_mm, *(effect.on_mechanism_mm(scene) for effect in self._effects)))
        scene.rho_mm = math.dist(head, foot)
        scene.travel_mm = scene.rho_mm - spec.head_zero_mm
        return scene

    def _place(self, scene: Scene, lengths: Lengths, centres: tuple[Point, Point]) -> None:
        """Elbows and P for the arms' angles."""
        elbows: list[Point] = []
        for i, (x, y) in enumerate(centres):
            angle = math.radians(scene.theta_deg[i])
            elbows.append((x + lengths.L[i] * math.cos(angle), y + lengths.L[i] * math.sin(angle)))
        scene.elbows_mm = (elbows[0], elbows[1])
        scene.r_mm = lower_meeting_point(elbows[0], lengths.l[0], elbows[1], lengths.l[1])

    def _reading_mm(self, scene: Scene) -> float:
        return scene.travel_mm + sum(effect.on_head_mm(scene) for effect in self._effects)


def lower_meeting_point(first: Point, first_mm: float, second: Point, second_mm: float) -> Point:
    """Where two circles meet, the lower of the two points (the workspace is below the base).

    :raises Unreachable: they do not meet
    """
    apart_x, apart_y = second[0] - first[0], second[1] - first[1]
    apart = math.hypot(apart_x, apart_y)
    if not abs(first_mm - second_mm) < apart < first_mm + second_mm:
        raise Unreachable("The distal links cannot meet with the arms at these angles.")
    cosine = (first_mm**2 + apart**2 - second_mm**2) / (2 * first_mm * apart)
    towards_second = math.atan2(apart_y, apart_x)
    opening = math.acos(cosine)
    points = [
        (first[0] + first_mm * math.cos(angle), first[1] + first_mm * math.sin(angle))
        for angle in (towards_second - opening, towards_second + opening)
    ]
    return min(points, key=lambda point: point[1])


def _sum(points: Iterable[Point]) -> Point:
    x_mm = y_mm = 0.0
    for x, y in points:
        x_mm += x
        y_mm += y
    return x_mm, y_mm


def _fresh(effect: Effect) -> Effect:
    """A copy without the memory of another machine."""
    return type(effect).model_validate(effect.model_dump())
