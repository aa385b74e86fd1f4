"""The position error that a model predicts: over the workspace, or at the measured poses of an arm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.diagnosis.tests_of_fit import without_neighbours
from station.fitting import position_error_field, rms_and_max
from station.model import Fit, identified
from station.records import Measurements, PositionError, Real


def position_errors(
    base: Fit, last: Fit, sd_factor: float, fresh: Measurements | None = None
) -> tuple[PositionError, PositionError]:
    """With the commands of the base model and of the last one, the last taken as true, mm.

    :param fresh: readings whose poses count as measured poses of an arm; what they measured does not matter
    """
    machine, commander = identified(last, sd_factor), identified(base)
    if machine is not None and commander is not None:
        return machine.position_error(commander), machine.position_error()
    return _of_arm(base, last, sd_factor, fresh)


def _of_arm(
    base: Fit, last: Fit, sd_factor: float, fresh: Measurements | None
) -> tuple[PositionError, PositionError]:
    """At the measured poses; the part that the last model does not explain is known from excluded blocks.

    The blocks are neighbours in the log: on a path, a pose between two others is predicted too well.
    """
    learned = last.model.mechanism.measurements
    covariance = last.solution.covariance * sd_factor**2
    parts = [_at(base, last, m, covariance) for m in (learned, fresh) if m is not None]
    rows = without_neighbours(last)
    known = float(np.mean(parts[0][1] ** 2))
    unexplained = np.sqrt(max(float(rows @ rows) / len(learned) - known, 0.0))
    difference, unknown = (np.concatenate(part) for part in zip(*parts, strict=True))
    after = np.hypot(unknown, unexplained)
    return rms_and_max(np.hypot(difference, after)), rms_and_max(after)


def _at(base: Fit, last: Fit, m: Measurements, covariance: Real) -> tuple[Real, Real]:
    """(K,) mm at the poses of m: the distance between both models, and the uncertainty of the last."""
    here = []
    for fit in (base, last):
        model = replace(fit.model, mechanism=fit.model.mechanism.of(m))
        learned_from = m is last.model.mechanism.measurements
        conditions = model.conditions(fit.x[: model.base_size], first=learned_from)
        here.append(model.observe(fit.x, model.bases(conditions)))
    before, after = here
    difference = (before.value - after.value).reshape(len(m), -1)
    jacobian = after.by_parameter.reshape(len(m), -1, len(last.x))
    unknown = position_error_field(np.zeros_like(difference), jacobian, covariance)
    return np.linalg.norm(difference, axis=1), unknown
