"""Measurement sequences in virtual time: a machine with known errors, measured as the station would.

The machine is the emulated one with its own physics; nothing of the identification is used to make
its readings.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np

from drivers.emulated.machine import lower_meeting_point
from drivers.emulated.spec import MachineSpec
from drivers.emulated.virtual import VirtualReading, VirtualRig
from station.five_bar import Robot, inverse
from station.mechanism import last_senses, needs_run_up
from station.plans import diagnostic_fresh_stops, make_plan
from station.records import Complex, Measurements, Real, Stop, number

ROOM_C = 20.0
SAMPLES = 5
"""Of a reading, as a station takes them."""
RUN_UP_DEG = 0.5
"""As `overshoot_deg` of a station file."""
Servo = Literal["exact", "whole pulses", "continuous"]
"""Where servos rest: on the commanded pulse; beside it on a whole pulse (eq. 35); beside it anywhere."""


class SimulatedMachine:
    """A five-bar with errors `truth` (12,), in the order of `station.five_bar.error_model`, mm and rad.

    `effects` are imperfections of the emulated machine (`drivers.emulated.imperfections`), each a table of a
    rig file; `noise` False silences the head; `tracked` records P by an instrument of its own too.
    """

    def __init__(
        self,
        robot: Robot,
        truth: Real,
        servo: Servo,
        seed: int,
        effects: Sequence[dict[str, Any]] = (),
        *,
        noise: bool = True,
        tracked: bool = False,
    ) -> None:
        self.truth = truth
        self._tracked = tracked
        self._stands = robot.zero_at_deg
        dtheta = np.degrees(truth[:2])
        self._rig = VirtualRig(
            MachineSpec.model_validate(
                dict(
                    e_mm=robot.e,
                    L_mm=robot.L,
                    l_mm=robot.l,
                    c_mm=robot.c,
                    d_mm=robot.d,
                    zero_offsets_deg=(dtheta[0], dtheta[1]),
                    e_error_mm=(truth[2], truth[3], truth[4], truth[5]),
                    L_error_mm=(truth[6], truth[7]),
                    l_error_mm=(truth[8], truth[9]),
                    drm_mm=(truth[10], truth[11]),
                    scatter=servo != "exact",
                    whole_pulses=servo != "continuous",
                    **({} if noise else {"scale_noise_mm": 0.0}),
                    effects=list(effects),
                )
            ),
            seed=seed,
        )

    def visit(self, theta_deg: Real, labels: Sequence[str] | None = None, samples: int = 1) -> Measurements:
        """Readings at drive angles theta_deg (K, 2), in order, each the mean of `samples` of the head."""
        taken = self._taken(theta_deg, samples)
        return self._measurements(taken, labels or [str(k) for k in range(len(taken))], samples)

    def run(self, stops: Sequence[Stop], samples: int = 1) -> Measurements:
        """Readings at stops, approached as the station does, with a run-up where it makes one."""
        taken = []
        for stop in stops:
            way = np.subtract(stop.theta_deg, self._stands)
            senses = last_senses(np.array(stop.approach), way)
            if needs_run_up(senses, way, RUN_UP_DEG):
                self._taken(np.subtract(stop.theta_deg, RUN_UP_DEG * senses)[None])
            taken += self._taken(np.array([stop.theta_deg]), samples)
            self._stands = stop.theta_deg
        return self._measurements(taken, [stop.position for stop in stops], samples)

    def diagnostic_run(self, robot: Robot, seed: int) -> tuple[Measurements, Measurements]:
        """The diagnostic sequence and the fresh readings after it, as a run of that plan measures them."""
        sequence = self.run(make_plan("diagnostic", robot).stops)
        fresh = self.run(diagnostic_fresh_stops(robot, self.truth[:2], seed))
        numbers = tuple(range(len(sequence) + 1, len(sequence) + len(fresh) + 1))
        return sequence, replace(fresh, ids=numbers)

    def _measurements(
        self, taken: Sequence[VirtualReading], labels: Sequence[str], samples: int
    ) -> Measurements:
        return Measurements(
            ids=tuple(range(1, len(taken) + 1)),
            t_s=np.array([r.t_s for r in taken]),
            theta=np.radians([r.theta_deg for r in taken]),
            approach=np.array([r.approach for r in taken], dtype=np.int8),
            distance=np.array([r.scale_mm for r in taken]),
            position=number(labels)[0],
            mount=np.zeros(len(taken), dtype=np.intp),
            samples=np.full(len(taken), samples, dtype=np.intp),
            temperature_c=np.array([ROOM_C + r.temperature_rise_k for r in taken]),
            tracker=np.array([r.true_point_mm for r in taken]) if self._tracked else None,
        )

    def stand(self, theta_deg: Real) -> Complex:
        """(K,) mm, where the platform truly stands at drive angles theta_deg (K, 2), come to in order."""
        return np.array([complex(*r.true_point_mm) for r in self._taken(theta_deg)])

    def arrive(self, theta: Real, before: Real) -> Measurements:
        """One reading at each of drive angles theta (K, 2), rad, each reached from `before` (K, 2)."""
        way = np.degrees(np.stack([before, theta], axis=1)).reshape(-1, 2)
        return self.visit(way).take(np.arange(1, len(way), 2))

    def arms(self, theta: Real, before: Real) -> Real:
        """(K, 2) rad, true angles of the proximal links less the feedback of the drives, reached likewise."""
        out = []
        for there, here in zip(before, theta, strict=True):
            reading = self._taken(np.degrees([there, here]))[1]
            out.append(np.subtract(self._rig.machine.arms_deg(), reading.theta_deg))
        return np.radians(out)

    def remount(self, c_mm: tuple[float, float]) -> None:
        """Mount the mechanism there, with a mounting error of its own."""
        self._rig.machine.remount(c_mm)

    def _taken(self, theta_deg: Real, samples: int = 1) -> list[VirtualReading]:
        return self._rig.measure([(float(a), float(b)) for a, b in theta_deg], samples=samples)

    def measure(self, stops: Sequence[Stop], samples: int = 1) -> Measurements:
        """The stops of a plan."""
        theta_deg = np.array([stop.theta_deg for stop in stops])
        return self.visit(theta_deg, [stop.position for stop in stops], samples)

    def read_at(self, robot: Robot, places: Complex, samples: int = 1) -> Measurements:
        """One reading at each of places (K,), mm, commanded with the nominal geometry."""
        return self.visit(np.degrees(inverse(robot.geometry, places)), samples=samples)


def known_to(servo: Servo) -> float | None:
    """`feedback_sd_deg` of a robot whose servos rest so: what feedback leaves open of a joint angle."""
    return None if servo == "continuous" else 0.0


def true_positions(robot: Robot, truth: Real, theta: Real) -> Complex:
    """(K,) mm, where P of a machine with errors `truth` (12,) stands at drive angles theta (K, 2), rad.

    By the emulated machine's own geometry, without the pulses and the scatter of a servo.
    """
    places = []
    for angles in theta + truth[:2]:
        elbows = [
            (x + truth[2 + 2 * i] + length * math.cos(a), y + truth[3 + 2 * i] + length * math.sin(a))
            for i, ((x, y), length, a) in enumerate(
                zip(robot.e, np.array(robot.L) + truth[6:8], angles, strict=True)
            )
        ]
        links = np.array(robot.l) + truth[8:10]
        places.append(complex(*lower_meeting_point(elbows[0], links[0], elbows[1], links[1])))
    return np.array(places)
