"""Single readings far off all others."""

from __future__ import annotations

import numpy as np

from station.diagnosis.mistakes.fitting import Fitted, Rough, fit
from station.diagnosis.mistakes.mistake import Mistake, ids, named
from station.diagnosis.runs_in_time import in_runs
from station.five_bar import Robot
from station.records import Index, Measurements, phrase

LARGEST_SHARE = 0.12
FAR_SDS = 8.0
CURED = 5.0
"""Factor by which excluding them has to reduce the scatter of the others."""
ALIKE = 2.0
"""Consecutive readings that are off to one side and agree within this factor indicate an event."""


def glitches(robot: Robot, m: Measurements, base: Fitted | None, agreed: Rough, file: str) -> Mistake | None:
    """A few readings, scattered over the file, without which the base model fits."""
    far = np.abs(agreed.residual_mm) > 1.0
    far |= ~np.isfinite(agreed.residual_mm)
    size = np.abs(agreed.residual_mm)
    if not far.any() and size.max() < FAR_SDS / 2.0 * float(np.median(size)):
        return None
    for _ in range(6):
        if far.sum() > LARGEST_SHARE * len(m):
            return None
        found = fit(robot, m, used=~far, start=agreed.p)
        if found is None:
            return None
        sd = 1.4826 * float(np.median(np.abs(found.residual_mm[~far])))
        sd = max(sd, 0.25 * float(np.median(found.row_sd)))
        again = np.abs(found.residual_mm) > FAR_SDS * sd
        if (again == far).all():
            break
        far = again
    if not far.any() or found is None:
        return None
    if base is not None and base.rms_mm < CURED * found.rms_mm and far.sum() > 1:
        return None
    if found.noise > 2.0:
        return None  # a machine with another defect: its diagnosis decides
    if _one_place(m, far) or _happened(m, far, found.residual_mm):
        return None
    rows = ids(m, np.flatnonzero(far))
    largest = float(np.abs(found.residual_mm[far]).max())
    return Mistake(
        "glitches",
        phrase(
            "glitch" if len(rows) == 1 else "glitches",
            rows=named(rows),
            largest_mm=largest,
            rms_um=found.rms_mm * 1e3,
        ),
        rows,
        "label",
        "fresh" if file == "fresh" else "readings",
    )


def _one_place(m: Measurements, far: np.ndarray) -> bool:
    """Whether every reading of the affected positions is off: then the position is at fault."""
    theta = np.degrees(m.theta)
    companions = bad = 0
    for k in np.flatnonzero(far):
        near = np.flatnonzero(np.abs(theta - theta[k]).max(axis=1) < 3.0)
        near = near[near != k]
        companions += len(near)
        bad += int(far[near].sum())
    return companions > 0 and bad > 0.5 * companions


def _happened(m: Measurements, far: np.ndarray, residual_mm: np.ndarray) -> bool:
    """Whether most of them form runs of similar deviations: a slip or a step, before or after."""

    def alike(row: Index) -> bool:
        size, sides = np.abs(residual_mm[row]), np.sign(residual_mm[row])
        one_side = bool(far[row].all()) and abs(sides.sum()) == len(row)
        return one_side and size.max() <= ALIKE * size.min()

    return bool(2 * in_runs(m, alike).sum() > far.sum())
