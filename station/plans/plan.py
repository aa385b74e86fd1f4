"""The definition of a plan, and the register of all plans.

A further plan is one module that registers itself (docs/how-to/add-a-plan.md); its texts are in
`station.messages`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.errors import InputRefused
from station.five_bar import Robot, excess_mm, inverse
from station.plans.duration import USUAL, Pace
from station.plans.prediction import predict
from station.records import (
    AnyReference,
    Complex,
    PlanDocument,
    PlanName,
    PlannedStop,
    PlanPrediction,
    Real,
    Stop,
)

ROUNDING_MM = 1e-6
"""By which a position on the edge of the workspace may miss it."""


class Visits(NamedTuple):
    """The positions that a plan measures, and their order."""

    positions: Complex
    """(K,) mm in O-xy."""
    order: NDArray[np.intp]
    """(R,) index of the position of each reading."""
    approach: NDArray[np.intp]
    """(R, 2) requested sign of each joint's last motion; 0 accepts that of the motion there."""


def each_once(positions: Complex) -> Visits:
    """Every one of positions (K,) once, in this order, with the side of approach of the direct motion."""
    count = len(positions)
    return Visits(positions, np.arange(count), np.zeros((count, 2), dtype=np.intp))


@dataclass(frozen=True)
class PlanDesign:
    """One way to choose the measured positions."""

    name: PlanName
    visits: Callable[[Robot], Visits]
    """For a robot.  :raises InputRefused: this robot cannot be measured so."""
    run_kind: str = "calibrate"
    """Name of the run kind in `station.run_kinds` that measures by this plan."""
    mounts: int = 1
    """Mounting points from which all positions are measured."""
    references: tuple[AnyReference, ...] = ()
    """What a person measures during the run, for the predicted accuracy: its value is the expected one."""


RECOMMENDED: PlanName = "full"
"""The default plan."""
_PLANS: dict[PlanName, PlanDesign] = {}
PLANS: Mapping[PlanName, PlanDesign] = MappingProxyType(_PLANS)
"""Every plan by its name."""


def register(design: PlanDesign) -> PlanDesign:
    """Register a plan. :raises ValueError: its name is in use."""
    if design.name in _PLANS:
        raise ValueError(f"the plan {design.name} is registered already")
    _PLANS[design.name] = design
    return design


@dataclass(frozen=True)
class Plan:
    """Stops in measuring order and the predicted accuracy."""

    name: PlanName
    stops: tuple[Stop, ...]
    robot: Robot
    pace: Pace = USUAL
    """The pace of the measuring station."""

    @cached_property
    def predicted(self) -> PlanPrediction:
        """The predicted accuracy of the stops, and their duration."""
        places = np.array([complex(*stop.target_mm) for stop in self.stops])
        design = PLANS[self.name]
        robot = self.robot.informed(design.references)
        accuracy = predict(robot, places, self.pace.samples, mounts=design.mounts)
        travel_deg, duration_s = self.pace.along(
            np.array([stop.theta_deg for stop in self.stops]),
            np.array([stop.approach for stop in self.stops]),
        )
        time = {"travel_deg": float(travel_deg.sum()), "duration_s": float(duration_s.sum())}
        return accuracy.model_copy(update=time)

    def document(self) -> PlanDocument:
        """The plan as `station plan --json` writes it."""
        return PlanDocument(
            plan=self.name,
            predicted=self.predicted,
            stops=tuple(
                PlannedStop(
                    stop=k + 1,
                    position=s.position,
                    x_mm=s.target_mm[0],
                    y_mm=s.target_mm[1],
                    theta1_deg=s.theta_deg[0],
                    theta2_deg=s.theta_deg[1],
                    approach1=s.approach[0],
                    approach2=s.approach[1],
                )
                for k, s in enumerate(self.stops)
            ),
        )

    def summary(self) -> str:
        """The predicted accuracy in a sentence."""
        found = self.predicted
        error, sd = found.position_error_mm, found.zero_offset_sd_deg
        return (
            f"Predicted: zero offsets to {sd[0]:.3f} and {sd[1]:.3f} deg (sd), "
            f"position error {error.rms:.3f} mm rms, {error.max:.3f} mm at worst. "
            f"With 95 % probability no error is above {found.bound_95_mm:.3f} mm. "
            f"{found.travel_deg or 0.0:.0f} deg of travel, {found.duration_s or 0.0:.0f} s."
        )


def _check_inside(name: PlanName, robot: Robot, positions: Complex) -> None:
    """:raises InputRefused: one of positions (K,) lies outside the workspace"""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    outside = np.flatnonzero(~(excess_mm(robot, positions) <= ROUNDING_MM))
    if outside.size:
        k = int(outside[0])
        x, y = positions[k].real, positions[k].imag
        raise InputRefused(
            f"Position P{k + 1} of the plan {name}, ({x:.1f}, {y:.1f}) mm, lies outside the workspace, "
            f"x from {x0:g} to {x1:g} mm and y from {y0:g} to {y1:g} mm; use another plan for this robot."
        )


def make_plan(name: PlanName, robot: Robot, dtheta: Real | None = None, pace: Pace = USUAL) -> Plan:
    """The plan for a robot; commands are compensated by dtheta (2,) rad if known.

    :param pace: pace of the station, for the duration

    :raises InputRefused: the plan is not possible for this robot.
    """
    positions, order, approach = PLANS[name].visits(robot)
    _check_inside(name, robot, positions)
    theta = np.degrees(inverse(robot.geometry, positions) - (np.zeros(2) if dtheta is None else dtheta))
    stops = tuple(
        Stop(
            position=f"P{k + 1}",
            target_mm=(float(positions[k].real), float(positions[k].imag)),
            theta_deg=(float(theta[k, 0]), float(theta[k, 1])),
            approach=(int(a[0]), int(a[1])),
        )
        for k, a in zip(order, approach, strict=True)
    )
    return Plan(name, stops, robot, pace)
