"""What is said differently of each kind of machine: the direction held least, the error of its position."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from station.fitting import Noise, describe_separability, position_error_field, rms_and_max
from station.five_bar import FiveBar
from station.identification import describe_weak_direction
from station.model import Fit, IdentifiedMachine
from station.records import Measurements, Real


@dataclass(frozen=True)
class BasePosterior:
    """What the chosen model of a five-bar knows of zero offsets, geometry and mechanism."""

    mechanism: FiveBar
    measurements: Measurements
    noise: Noise
    sd_factor: float
    dtheta: Real
    covariance: Real


def weak_direction(fit: Fit, noise: Noise, sd_factor: float) -> dict[str, Any]:
    """The contract's `weak_direction`, with the effects in the model."""
    mechanism, size = fit.model.mechanism, fit.model.base_size
    if not isinstance(mechanism, FiveBar):
        return describe_separability(mechanism, fit.solution, sd_factor)
    covariance = fit.solution.covariance[:size, :size] * sd_factor**2
    return describe_weak_direction(
        BasePosterior(mechanism, mechanism.measurements, noise, sd_factor, fit.x[:2], covariance)
    )


def position_errors(base: Fit, last: Fit, sd_factor: float) -> tuple[dict[str, float], dict[str, float]]:
    """{rms, max} in mm with the commands of the base model and of the last one, the last taken as the truth.

    Of a five-bar over its workspace; of an arm, whose poses are many, over those that were measured.
    """
    if isinstance(base.model.mechanism, FiveBar):
        machine = IdentifiedMachine.of(last, sd_factor)
        return machine.position_error(IdentifiedMachine.of(base)), machine.position_error()
    readings, unknowns = len(last.model.mechanism.measurements), len(last.x)
    apart = (base.residual_mm - last.residual_mm).reshape(readings, -1)
    jacobian = (last.solution.jacobian * last.row_sd[:, None]).reshape(readings, -1, unknowns)
    covariance = last.solution.covariance * sd_factor**2
    unknown = position_error_field(np.zeros_like(apart), jacobian, covariance)
    return rms_and_max(np.hypot(np.linalg.norm(apart, axis=1), unknown)), rms_and_max(unknown)


def extent(fit: Fit) -> str:
    """Over what position errors are predicted, in words."""
    return "the workspace" if isinstance(fit.model.mechanism, FiveBar) else "the measured poses"
