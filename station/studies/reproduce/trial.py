"""One simulated machine calibrated by every method: the published one as printed, and ours.

| method | readings | what it knows beforehand |
|---|---|---|
| `paper` | six a pass, angles as commanded | nothing |
| `paper, feedback` | six a pass, angles as the drives report them | nothing |
| `full` | 120 of plan `full` | the tolerances |
| `rapid` | six of plan `rapid` | the tolerances |
| `rapid, memory` | six | and what one `full` run left before both zero offsets changed |
| `full, dr_M` | 120 | and dr_M to 0.02 mm |
| `rapid, dr_M` | six | and dr_M to 0.02 mm |
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from station.five_bar import SIZE, FiveBar, Robot, Tolerances, inverse
from station.identification import Identification, identify
from station.plans import make_plan
from station.published import MU_0_DEG, compensation_accuracy
from station.published import identify as identify_as_published
from station.records import PlanName, Real, Stop
from station.studies.reproduce.position_error import edge, home, position_errors, six, whole_workspace
from station.studies.reproduce.printed import TOLERANCE_MM, true_errors
from station.studies.simulation import Servo, SimulatedMachine, known_to

KNOWN_DRM_SD_MM = 0.02
PASSES = 10
"""Shown in Fig. 9; the calibration itself ends with the first mu below mu_0."""
EARLIER_ZERO_OFFSETS_DEG = (-0.7, 1.2)
"""Of the run that left the memory: before both changed."""
PAPER, PAPER_FEEDBACK = "paper", "paper, feedback"
FULL, RAPID, RAPID_MEMORY = "full", "rapid", "rapid, memory"
FULL_DRM, RAPID_DRM = "full, dr_M", "rapid, dr_M"
OURS = (FULL, RAPID, RAPID_MEMORY, FULL_DRM, RAPID_DRM)


@dataclass(frozen=True)
class Pass:
    """One pass of the published iteration."""

    total_deg: Real
    """(2,) compensation value so far (eq. 33)."""
    drm: complex
    """Sum of the MAEMM so far, mm."""
    mu_deg: float | None
    condition: float


@dataclass(frozen=True)
class Outcome:
    """What one calibration is worth."""

    dtheta_deg: Real
    """(2,) identified."""
    drm: complex
    home_mm: float
    six_mm: float
    """Largest of the six positions of Table 4."""
    edge_mm: Real
    """(42,) of Fig. 12."""
    workspace_mm: float
    """Largest over the whole workspace."""
    passes: tuple[Pass, ...] = ()
    converged: bool = True


@dataclass(frozen=True, slots=True)
class Conditions:
    """Which machine is simulated."""

    group: int
    servo: Servo
    samples: int = 1
    """Of the head at each stop."""

    @property
    def robot(self) -> Robot:
        """The robot file that a user would have."""
        tolerance = TOLERANCE_MM[0 if self.group <= 3 else 1]
        return replace(
            Robot.default(),
            tolerances=Tolerances(e_mm=tolerance, link_mm=tolerance),
            feedback_sd_deg=known_to(self.servo),
        )

    @property
    def truth(self) -> Real:
        return true_errors(self.group)

    @property
    def earlier_truth(self) -> Real:
        """The same machine when its memory was made."""
        truth = self.truth
        truth[:2] = np.radians(EARLIER_ZERO_OFFSETS_DEG)
        return truth

    def machine(self, seed: int, truth: Real | None = None) -> SimulatedMachine:
        return SimulatedMachine(self.robot, self.truth if truth is None else truth, self.servo, seed)


def by_paper(conditions: Conditions, seed: int, feedback: bool) -> Outcome:
    """Sections 4 and 5: measure, identify, compensate, until mu < mu_0."""
    passes = _passes(conditions, seed, feedback)
    ended = next((p for p in passes if p.mu_deg is not None and p.mu_deg < MU_0_DEG), None)
    last = ended or passes[-1]
    identified = np.zeros(SIZE)
    identified[:2] = np.radians(last.total_deg)
    identified[10], identified[11] = last.drm.real, last.drm.imag
    outcome = _outcome(conditions, identified)
    return replace(outcome, passes=passes, converged=ended is not None)


def _passes(conditions: Conditions, seed: int, feedback: bool) -> tuple[Pass, ...]:
    robot, machine = conditions.robot, conditions.machine(seed)
    places = inverse(robot.geometry, six(robot))
    pulse = np.radians(robot.pulse_deg)
    total, drm, earlier = np.zeros(2), 0j, None
    passes: list[Pass] = []
    for _ in range(PASSES):
        command = np.round((places - total) / pulse) * pulse
        measured = machine.visit(np.degrees(command), samples=conditions.samples)
        theta = measured.theta if feedback else command
        step = identify_as_published(robot.geometry, theta + total, measured.distance, drm)
        total, drm = total + step.dtheta, drm + step.drm
        mu = None if earlier is None else float(np.degrees(compensation_accuracy(step.dtheta, earlier)))
        earlier = step.dtheta
        passes.append(Pass(np.degrees(total), drm, mu, step.condition))
    return tuple(passes)


def by_ours(conditions: Conditions, seed: int) -> dict[str, Outcome]:
    """The measurement model with each plan and each prior knowledge."""
    fits = fits_of(conditions, seed)
    return {method: _outcome(conditions, fit.p[:SIZE]) for method, fit in fits.items()}


def fits_of(conditions: Conditions, seed: int) -> dict[str, Identification[FiveBar]]:
    """The identifications behind `by_ours`."""
    robot, samples = conditions.robot, conditions.samples
    full, rapid = stops_of(conditions, "full"), stops_of(conditions, "rapid")
    machine = conditions.machine(seed)
    six_readings = machine.measure(rapid, samples)
    earlier = conditions.machine(-1 - seed, conditions.earlier_truth)
    memory = identify(robot, earlier.measure(full, samples)).lasting
    careful = with_known_mechanism(robot, conditions.truth, seed)
    return {
        FULL: identify(robot, machine.measure(full, samples)),
        RAPID: identify(robot, six_readings),
        RAPID_MEMORY: identify(robot, six_readings, memory),
        FULL_DRM: identify(careful, machine.measure(stops_of(conditions, "full", True), samples)),
        RAPID_DRM: identify(careful, six_readings),
    }


def with_known_mechanism(robot: Robot, truth: Real, seed: int) -> Robot:
    """Somebody has measured dr_M, to 0.02 mm."""
    x, y = truth[10:12] + np.random.default_rng(seed).normal(0.0, KNOWN_DRM_SD_MM, 2)
    return robot.with_mechanism((float(x), float(y)), (KNOWN_DRM_SD_MM, KNOWN_DRM_SD_MM))


@cache
def stops_of(conditions: Conditions, plan: PlanName, mechanism_known: bool = False) -> Sequence[Stop]:
    """The plan's stops, made once per kind of machine."""
    robot = conditions.robot
    if mechanism_known:
        robot = robot.with_mechanism(robot.drm, (KNOWN_DRM_SD_MM, KNOWN_DRM_SD_MM))
    return make_plan(plan, robot).stops


def _outcome(conditions: Conditions, identified: Real) -> Outcome:
    robot, truth = conditions.robot, conditions.truth
    return Outcome(
        dtheta_deg=np.degrees(identified[:2]),
        drm=complex(identified[10], identified[11]),
        home_mm=float(position_errors(robot, truth, identified, home(robot))[0]),
        six_mm=float(position_errors(robot, truth, identified, six(robot)).max()),
        edge_mm=position_errors(robot, truth, identified, edge(robot)),
        workspace_mm=float(position_errors(robot, truth, identified, whole_workspace(robot)).max()),
    )
