"""Whether the readout jumped during a calibration, and at which reading.

Lost counts shift every later reading by the same amount.  The smooth model takes up part of that, so a run
may look well; a step at one reading, beside the model, then explains what is left over far better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc

from station.five_bar import FiveBar, Robot
from station.records import CalibrationResult, Reading, Real, because, from_readings

LEAST_MM = 0.03
"""A smaller step may be creep or warming."""
_ITERATIONS = 8
_DOUBT_P = 1e-3
_LEAST_GAIN = 30.0
"""Of chi-square, by the step."""
_FITS = 4.0
"""Largest chi-square per degree of freedom that the step may leave."""


@dataclass(frozen=True, slots=True)
class Jump:
    """A step of the readout."""

    reading: int
    """The first reading after it."""
    position: str
    size_mm: float


def find_jump(robot: Robot, readings: Sequence[Reading]) -> Jump | None:
    """The step that the readings of one run contradict the model by; None when they do not, or not by a step.

    Geometry is free within its tolerances.  Linear about the best fit without a step: each candidate step is
    projected past all that the parameters can take up.
    """
    measurements = from_readings(list(readings))
    mechanism = FiveBar(robot, measurements)
    left, free = _left_over(mechanism)
    # of readings and priors together: the projector's trace
    dof = max(1, round(float(np.trace(free))))
    square = float(left @ left)
    if not np.isfinite(square) or chdtrc(dof, square) > _DOUBT_P:
        return None
    from_each_on = np.tril(np.ones((len(readings), len(readings)))) / mechanism.row_sd[:, None]
    steps = free[:, : len(readings)] @ from_each_on
    norms = np.einsum("ij,ij->j", steps, steps)
    along = steps.T @ left
    gains = np.where(norms > 1e-9, along**2 / np.maximum(norms, 1e-9), 0.0)
    gains[0] = 0.0  # a step before the first reading is the unknown offset
    at = int(np.argmax(gains))
    size_mm = float(along[at] / norms[at])
    left_after = square - float(gains[at])
    if gains[at] < _LEAST_GAIN or abs(size_mm) < LEAST_MM or left_after > _FITS * dof:
        return None
    return Jump(readings[at].reading, readings[at].position, size_mm)


def without_jump(result: CalibrationResult, robot: Robot, readings: Sequence[Reading]) -> CalibrationResult:
    """The result, or a failed one that names the reading at which the readout jumped."""
    jump = find_jump(robot, readings)
    if jump is None:
        return result
    reason = because(
        "readout_jumped", reading=jump.reading, position=jump.position, jump_um=round(jump.size_mm * 1e3, 1)
    )
    changed = {"verdict": "fail", "outcome": "unexplained", "reason": reason, "lack_of_fit": reason.text}
    return result.model_copy(update=changed)


def _left_over(mechanism: FiveBar) -> tuple[Real, Real]:
    """What the best fit leaves over of readings and priors (K + Q,), in standard deviations.

    And the projector (K + Q, K + Q) past all that the parameters can take up.
    """
    p = mechanism.start
    prior_sd = np.array([parameter.prior_sd for parameter in mechanism.parameters])
    known = np.isfinite(prior_sd)
    pull = np.eye(len(p))[known] / prior_sd[known, None]
    measured, sd = mechanism.measurements.distance, mechanism.row_sd
    for _ in range(_ITERATIONS):
        at = mechanism.observe(p, mechanism.theta)
        left = np.concatenate([(measured - at.value) / sd, pull @ (mechanism.start - p)])
        by_parameter = np.vstack([at.by_parameter / sd[:, None], pull])
        p = p + np.linalg.lstsq(by_parameter, left, rcond=None)[0]
    basis, _ = np.linalg.qr(by_parameter)
    free = np.eye(len(left)) - basis @ basis.T
    return free @ left, free
