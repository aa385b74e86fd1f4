"""The plans: `paper` and `rapid` (the places of Fig. 7) and `full` (places chosen by exchange).

`rapid` lives from the memory of a full run.  Places crowded into the corners would serve it no better
and could not contradict a wrong memory (docs/decisions/0004-rapid-places.md).

`full` visits 24 places, chosen for the position error; each is read three times from one side and
twice from the other, and the order keeps time apart from place so that a drift cannot pass for
geometry.

`diagnostic` looks for the cause of a residual (`station.plans.diagnostic_sequence`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from station.errors import InputRefused
from station.fitting import common_sd_deg, position_error_summary, tolerance_prior
from station.five_bar import GRID, FiveBar, Robot, inverse
from station.plans.diagnostic_sequence import diagnostic_grid, diagnostic_visits
from station.plans.exchange_algorithm import choose
from station.published import boundary_positions, positions_per_edge
from station.records import (
    Complex,
    Measurements,
    PlanDocument,
    PlanName,
    PlannedStop,
    PlanPrediction,
    PredictedSd,
    Real,
    Stop,
)

CANDIDATES = (41, 17)
INSET_MM = 4.0
"""Kept free of the workspace's edge for the overshoot of an approach."""
FULL_PLACES = 24
APART_MM = 10.0
TIMES = (3, 2)
"""How often each place is read, from one side and from the other."""
SCALE_TRAVEL_MM = 350.0
ORDERS_TRIED = 200
FLAT_PRIOR_SD_MM = 1e4
"""Stands for "nothing is known" of the reading offset while designing."""


@dataclass(frozen=True)
class Plan:
    """Stops in measuring order and what they will tell."""

    name: PlanName
    stops: tuple[Stop, ...]
    robot: Robot

    @cached_property
    def predicted(self) -> PlanPrediction:
        """The accuracy that the stops promise."""
        return predict(self.robot, np.array([complex(*stop.target_mm) for stop in self.stops]))

    def document(self) -> PlanDocument:
        """As `station plan --json` writes it."""
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
        error, sd = self.predicted.position_error_mm, self.predicted.zero_offset_sd_deg
        return (
            f"Predicted: zero offsets to {sd[0]:.3f} and {sd[1]:.3f} deg (sd), "
            f"position error {error.rms:.3f} mm rms, {error.max:.3f} mm at worst."
        )


def make_plan(name: PlanName, robot: Robot, dtheta: Real | None = None) -> Plan:
    """The plan for a robot; commands compensated by dtheta (2,) rad when some is known.

    :raises InputRefused: the scale's travel does not cover the workspace.
    """
    dtheta = np.zeros(2) if dtheta is None else dtheta
    if name == "full":
        places = _choose(robot, _candidates(robot), FULL_PLACES)
        order, approach = _both_sides(places)
    elif name == "diagnostic":
        places = diagnostic_grid(robot, INSET_MM)
        order, approach = diagnostic_visits()
    else:
        n = positions_per_edge(robot)
        places = boundary_positions(robot.workspace_x, robot.workspace_y, n)
        order, approach = np.arange(len(places)), np.zeros((len(places), 2), dtype=int)
    theta = np.degrees(inverse(robot.geometry, places) - dtheta)
    stops = tuple(
        Stop(
            position=f"P{k + 1}",
            target_mm=(float(places[k].real), float(places[k].imag)),
            theta_deg=(float(theta[k, 0]), float(theta[k, 1])),
            approach=(int(a[0]), int(a[1])),
        )
        for k, a in zip(order, approach, strict=True)
    )
    return Plan(name, stops, robot)


def predict(robot: Robot, places: Complex) -> PlanPrediction:
    """Accuracy that one reading at each of places (K,) promises, by specification."""
    mechanism = _at(robot, places)
    covariance = np.linalg.inv(_known(mechanism) + _rows(mechanism).T @ _rows(mechanism))
    mean = np.array([p.prior_mean for p in mechanism.parameters])
    error, jacobian = mechanism.position_errors(mean)
    sd = np.degrees(np.sqrt(np.diag(covariance)[:2]))
    sd_mm = np.sqrt(np.einsum("gdi,ij,gdj->g", jacobian, covariance, jacobian))
    return PlanPrediction(
        zero_offset_sd_deg=(float(sd[0]), float(sd[1])),
        common_sd_deg=common_sd_deg(covariance),
        position_error_mm=position_error_summary(np.zeros_like(error), jacobian, covariance),
        map=tuple(
            PredictedSd(x_mm=float(r.real), y_mm=float(r.imag), sd_mm=float(s))
            for r, s in zip(mechanism.workspace, sd_mm, strict=True)
        ),
    )


def _candidates(robot: Robot) -> Complex:
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    x = np.linspace(x0 + INSET_MM, x1 - INSET_MM, CANDIDATES[0])
    y = np.linspace(y0 + INSET_MM, y1 - INSET_MM, CANDIDATES[1])
    places = (x[:, None] + 1j * y[None, :]).ravel()
    travel = np.abs(places - robot.geometry.cd)
    if np.ptp(travel) > SCALE_TRAVEL_MM:
        raise InputRefused(
            f"The workspace needs {np.ptp(travel):.0f} mm of the scale's {SCALE_TRAVEL_MM:.0f} mm travel; "
            "check [workspace] and [mechanism] in the robot file."
        )
    return np.asarray(places)


def _at(robot: Robot, places: Complex) -> FiveBar:
    """The mechanism as if readings had been taken at places."""
    count = len(places)
    return FiveBar(
        robot,
        Measurements(
            ids=tuple(range(count)),
            t_s=np.zeros(count),
            theta=inverse(robot.geometry, places),
            approach=np.zeros((count, 2), dtype=np.int8),
            distance=np.zeros(count),
            position=np.arange(count),
            mount=np.zeros(count, dtype=np.intp),
            samples=np.ones(count, dtype=np.intp),
        ),
    )


def _rows(mechanism: FiveBar) -> Real:
    mean = np.array([p.prior_mean for p in mechanism.parameters])
    at = mechanism.observe(mean, mechanism.theta)
    return np.asarray(at.by_parameter / mechanism.row_sd[:, None])


def _known(mechanism: FiveBar) -> Real:
    root = tolerance_prior(mechanism).root
    information = root.T @ root
    flat = np.diag(information) == 0.0
    information[flat, flat] = 1.0 / FLAT_PRIOR_SD_MM**2
    return np.asarray(information)


def _choose(robot: Robot, candidates: Complex, count: int) -> Complex:
    mechanism = _at(robot, candidates)
    mean = np.array([p.prior_mean for p in mechanism.parameters])
    jacobian = mechanism.position_errors(mean)[1]
    weight = np.einsum("gdi,gdj->ij", jacobian, jacobian) / (GRID[0] * GRID[1])
    chosen = choose(_rows(mechanism), candidates, _known(mechanism), weight, count, APART_MM)
    return np.asarray(candidates[chosen])


def _both_sides(places: Complex) -> tuple[np.ndarray, np.ndarray]:
    """Order of visits (R,) and approach signs (R, 2): every place from both sides, several times.

    Half the places are approached with both joints in the same sense, half in opposite senses, so
    that what one joint's direction does is not mixed up with the other's.
    """
    visits: list[tuple[int, int, int]] = []
    for k in range(len(places)):
        second = 1 if k % 2 == 0 else -1
        visits += [(k, 1, second)] * TIMES[0] + [(k, -1, -second)] * TIMES[1]
    table = np.array(visits)
    return _keep_time_apart(places, table)


def _keep_time_apart(places: Complex, visits: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of many random orders the one whose time tells least about place and approach.  Always the same one."""
    rng = np.random.default_rng(0)
    x, y = places.real[visits[:, 0]], places.imag[visits[:, 0]]
    what = np.column_stack([x, y, x * x, x * y, y * y, visits[:, 1], visits[:, 2]])
    what = (what - what.mean(axis=0)) / what.std(axis=0)
    time = np.linspace(-1.0, 1.0, len(visits))
    when = np.column_stack([time, time**2 - np.mean(time**2)])
    when /= when.std(axis=0)
    best, least = np.arange(len(visits)), np.inf
    for _ in range(ORDERS_TRIED):
        order = rng.permutation(len(visits))
        link = float(np.abs(when.T @ what[order]).max()) / len(visits)
        if link < least:
            best, least = order, link
    return visits[best, 0], visits[best, 1:]
