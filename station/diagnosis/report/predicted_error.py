"""The position error that a model predicts: over the workspace, or at the measured poses of an arm."""

from __future__ import annotations

import numpy as np

from station.diagnosis.tests_of_fit import predicted_by_others
from station.fitting import position_error_field, rms_and_max
from station.model import Fit, identified
from station.records import PositionError


def position_errors(base: Fit, last: Fit, sd_factor: float) -> tuple[PositionError, PositionError]:
    """With the commands of the base model and of the last one, the last taken as true, mm."""
    machine, commander = identified(last, sd_factor), identified(base)
    if machine is not None and commander is not None:
        return machine.position_error(commander), machine.position_error()
    return _of_arm(base, last, sd_factor)


def _of_arm(base: Fit, last: Fit, sd_factor: float) -> tuple[PositionError, PositionError]:
    """At the measured poses; the part that the last model does not explain is known from excluded blocks."""
    readings, unknowns = len(last.model.mechanism.measurements), len(last.x)
    difference = (base.residual_mm - last.residual_mm).reshape(readings, -1)
    jacobian = (last.solution.jacobian * last.row_sd[:, None]).reshape(readings, -1, unknowns)
    covariance = last.solution.covariance * sd_factor**2
    unknown = position_error_field(np.zeros_like(difference), jacobian, covariance)
    rows = predicted_by_others(last.solution, last.model.mechanism) * last.row_sd
    unexplained = np.sqrt(max(float(rows @ rows) / readings - float(np.mean(unknown**2)), 0.0))
    after = np.hypot(unknown, unexplained)
    return rms_and_max(np.hypot(np.linalg.norm(difference, axis=1), after)), rms_and_max(after)
