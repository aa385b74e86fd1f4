"""The emulated machine with an effect in it, walked in virtual time as the station would."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from drivers.emulated.imperfections import AnyEffect
from drivers.emulated.spec import MachineSpec
from drivers.emulated.virtual import VirtualReading, VirtualRig
from station.five_bar.kinematics import inverse
from station.five_bar.robot_file import Robot
from station.records import Complex, Measurements, Real, number

ROBOT = Robot.default()
ZERO_OFFSETS_DEG = (1.1, -0.7)
ROOM_C = 20.0
TEN = 10
SETTLE_S = 1.0
EFFECTS: TypeAdapter[AnyEffect] = TypeAdapter(AnyEffect)


class Emulated:
    """One machine with errors within tolerance and effects as its rig file would say them."""

    def __init__(
        self,
        *effects: dict[str, Any],
        seed: int = 1,
        recorded_temperature: bool = True,
        tracked: bool = False,
    ) -> None:
        rng = np.random.default_rng(seed)
        self.tracked = tracked
        self.recorded_temperature = recorded_temperature
        self.rng = rng
        small = rng.normal(0.0, 0.02, 8).tolist()
        self._rig = VirtualRig(
            MachineSpec(
                zero_offsets_deg=ZERO_OFFSETS_DEG,
                e_error_mm=(small[0], small[1], small[2], small[3]),
                L_error_mm=(small[4], small[5]),
                l_error_mm=(small[6], small[7]),
                drm_mm=(1.0 + float(rng.normal(0.0, 0.05)), 0.5 + float(rng.normal(0.0, 0.05))),
                head_zero_mm=580.0,
                effects=tuple(EFFECTS.validate_python(effect) for effect in effects),
            ),
            seed=seed,
        )
        self._count = 0
        self._positions: list[str] = []

    def walk(self) -> Measurements:
        """120 readings: ten places three times over, a 9 x 5 grid there and back."""
        few = self.interior(TEN)
        grid = ROBOT.workspace_grid(9, 5).reshape(9, 5)
        grid[1::2] = grid[1::2, ::-1]
        there = grid.ravel()
        places = np.concatenate([np.tile(few, 3), there, there[::-1]])
        across = [f"g{k}" for k in range(there.size)]
        return self.measure(places, [f"r{k}" for k in range(TEN)] * 3 + across + across[::-1])

    def fresh(self) -> Measurements:
        """40 readings at random interior places."""
        return self.measure(self.interior(40), [f"f{k}" for k in range(40)])

    def interior(self, count: int) -> Complex:
        """Random places of the workspace."""
        (x0, x1), (y0, y1) = ROBOT.workspace_x, ROBOT.workspace_y
        return np.asarray(self.rng.uniform(x0, x1, count) + 1j * self.rng.uniform(y0, y1, count))

    def measure(self, places: Complex, labels: Sequence[str]) -> Measurements:
        """One reading at each place, commanded by nominal geometry."""
        taken = self.stand(np.degrees(inverse(ROBOT.geometry, places)))
        first = self._count + 1
        self._count += len(taken)
        rise = np.array([r.temperature_rise_k for r in taken])
        return Measurements(
            ids=tuple(range(first, first + len(taken))),
            t_s=np.array([r.t_s for r in taken]),
            theta=np.radians([r.theta_deg for r in taken]),
            approach=np.array([r.approach for r in taken], dtype=np.int8),
            distance=np.array([r.scale_mm for r in taken]),
            position=number(labels)[0],
            mount=np.zeros(len(taken), dtype=np.intp),
            samples=np.ones(len(taken), dtype=np.intp),
            temperature_c=ROOM_C + rise if self.recorded_temperature else None,
            tracker=np.array([r.true_point_mm for r in taken]) if self.tracked else None,
        )

    def stand(self, theta_deg: Real) -> list[VirtualReading]:
        """Readings with the truth at joint commands theta_deg (K, 2)."""
        return [self._rig.stop_at((float(a), float(b)), settle_s=SETTLE_S) for a, b in theta_deg]


def to_csv(measurements: Measurements) -> str:
    """As a measurement file."""
    m = measurements
    header = "reading,t_s,theta1_deg,theta2_deg,approach1,approach2,scale_mm,position"
    theta = np.degrees(m.theta)
    rows = [
        f"{m.ids[k]},{m.t_s[k]:.3f},{theta[k, 0]:.6f},{theta[k, 1]:.6f},"
        f"{m.approach[k, 0]},{m.approach[k, 1]},{m.distance[k]:.5f},{m.position[k]}"
        for k in range(len(m))
    ]
    return "\n".join([header, *rows, ""])
