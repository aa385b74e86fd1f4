"""Measurement sequences in virtual time: the machine without wires and without waiting."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from drivers.emulated.imperfections.base import JointNumber
from drivers.emulated.machine import Machine
from drivers.emulated.spec import MachineSpec

_JOINTS: tuple[JointNumber, JointNumber] = (1, 2)
_LEAST_RPM = 0.1


class VirtualClock:
    """A clock that advances only on request."""

    def __init__(self) -> None:
        self.time_s = 0.0

    def __call__(self) -> float:
        return self.time_s

    def advance_to(self, time_s: float) -> None:
        """Never goes back."""
        self.time_s = max(self.time_s, time_s)


@dataclass(frozen=True, slots=True)
class VirtualReading:
    """The reading that the station would have recorded at one stop, with the true values."""

    t_s: float
    theta_deg: tuple[float, float]
    """Drive feedback, nominal frame."""
    approach: tuple[int, int]
    scale_mm: float
    temperature_rise_k: float
    true_point_mm: tuple[float, float]


class VirtualRig:
    """A machine in virtual time, moved from stop to stop."""

    def __init__(self, spec: MachineSpec, *, seed: int | None = None) -> None:
        self.clock = VirtualClock()
        self.machine = Machine(spec, self.clock, seed=seed)
        self._spec = spec

    def stop_at(
        self, theta_deg: tuple[float, float], *, rpm: float = 100.0, settle_s: float = 0.2, samples: int = 1
    ) -> VirtualReading:
        """Move both joints to a command (nominal frame), wait, and read.

        :param samples: number of readings of the head that are averaged
        """
        spec, machine = self._spec, self.machine
        targets = [self._pulses(i, angle) for i, angle in enumerate(theta_deg)]
        ways = [
            abs(target - axis.feedback_pulses()) for target, axis in zip(targets, machine.axes, strict=True)
        ]
        longest = max(ways) or 1
        for joint, target, way in zip(_JOINTS, targets, ways, strict=True):
            # both joints arrive together, as under the station
            machine.command(joint, target, max(rpm * way / longest, _LEAST_RPM))
        self.clock.advance_to(machine.rests_from_s + settle_s)
        scale_mm = sum(machine.head_mm() for _ in range(samples)) / samples
        first, second = machine.axes
        return VirtualReading(
            t_s=self.clock(),
            theta_deg=(
                spec.zero_at_deg[0] + spec.sign[0] * first.feedback_pulses() / spec.pulses_per_deg,
                spec.zero_at_deg[1] + spec.sign[1] * second.feedback_pulses() / spec.pulses_per_deg,
            ),
            approach=(first.direction, second.direction),
            scale_mm=scale_mm,
            temperature_rise_k=machine.temperature_rise_k(),
            true_point_mm=machine.point_mm(),
        )

    def measure(self, stops_deg: Iterable[tuple[float, float]], *, samples: int = 1) -> list[VirtualReading]:
        """One reading at each stop, in order."""
        return [self.stop_at(stop, samples=samples) for stop in stops_deg]

    def _pulses(self, i: int, theta_deg: float) -> int:
        spec = self._spec
        return round(spec.sign[i] * (theta_deg - spec.zero_at_deg[i]) * spec.pulses_per_deg)
