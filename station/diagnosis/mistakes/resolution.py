"""Angles that are not the drives' feedback at full resolution: rounded, or commanded."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from station.diagnosis.mistakes.duplicates import by_joint_mm
from station.diagnosis.mistakes.fitting import Fitted
from station.diagnosis.mistakes.mistake import Mistake, angle_columns
from station.five_bar import SCALE_SD_MM, Robot
from station.records import Measurements, Real, phrase

STEPS_DEG = tuple(m * 10.0**-k for k in range(5) for m in (5, 2, 1))
"""From coarse to fine."""
STEPS_RAD = tuple(m * 10.0**-k for k in range(2, 6) for m in (5, 2, 1))
ON_STEP = 1e-6
COSTLY = 2.0
"""A resolution is reported if its effect is this many times the head's noise."""
SEEN = 0.4
"""and the readings scatter by at least this share of its expected effect."""
SAME_PLACE_DEG = 0.03
FEWEST_PAIRS = 6
IDENTICAL = 0.97
SCATTER = 2.5
"""Scatter of repeats with identical angles over the head's noise."""
WANDERS = 0.5
"""Correlation of neighbours in time above which the scatter is a drift."""
OFF_GRID = 0.1
"""Distance from the pulse grid, in pulses, above which an angle is not on it."""


def coarse_angles(robot: Robot, m: Measurements, base: Fitted | None, file: str) -> Mistake | None:
    """All angles of a column are multiples of a step with a larger effect than the noise."""
    by_joint = by_joint_mm(robot, m)
    steps = [_step_deg(np.degrees(m.theta[:, i]), m.theta[:, i]) for i in (0, 1)]
    coarse = [i for i in (0, 1) if steps[i] > 1.5 * robot.pulse_deg]
    if not coarse:
        return None
    square = sum(float(np.nanmean((np.radians(steps[i]) * by_joint[:, i]) ** 2)) / 12.0 for i in coarse)
    cost_mm = float(np.sqrt(square))
    if cost_mm < COSTLY * SCALE_SD_MM or base is None or base.rms_mm < SEEN * cost_mm:
        return None
    step = max(steps[i] for i in coarse)
    return Mistake(
        "coarse_angles",
        phrase(
            "coarse_angles",
            columns=angle_columns(coarse),
            step_deg=step,
            cost_um=cost_mm * 1e3,
            pulse_deg=robot.pulse_deg,
        ),
        (),
        "refused",
        "fresh" if file == "fresh" else "readings",
    )


def is_coarse(robot: Robot, m: Measurements) -> bool:
    """Whether a column's angles are multiples of a step coarser than the pulse, whatever its effect."""
    steps = (_step_deg(np.degrees(m.theta[:, i]), m.theta[:, i]) for i in (0, 1))
    return any(step > 1.5 * robot.pulse_deg for step in steps)


def _step_deg(degrees: Real, rad: Real) -> float:
    """The coarsest step that all values are multiples of, in deg; 0 if there is no relevant one."""
    found = 0.0
    for values, steps, unit in ((degrees, STEPS_DEG, 1.0), (rad, STEPS_RAD, 180.0 / np.pi)):
        for step in steps:
            if np.abs(values / step - np.round(values / step)).max() < ON_STEP / step * 1e-1 + 1e-7:
                found = max(found, step * unit)
                break
    return found


def commanded_angles(robot: Robot, m: Measurements, base: Fitted | None, file: str) -> Mistake | None:
    """Visits of one position with identical angles, whose readings scatter as servos do."""
    firsts, seconds = _visits(m)
    if len(firsts) < FEWEST_PAIRS or base is None:
        return None
    same = np.abs(m.theta[firsts] - m.theta[seconds]) < 1e-9
    joints = [i for i in (0, 1) if np.mean(same[:, i]) >= IDENTICAL]
    if not joints:
        return None
    alike = np.all(m.approach[firsts] == m.approach[seconds], axis=1) & (m.mount[firsts] == m.mount[seconds])
    if alike.sum() < FEWEST_PAIRS:
        alike[:] = True
    apart = (base.residual_mm[firsts] - base.residual_mm[seconds])[alike]
    scatter_mm = float(np.median(np.abs(apart))) * 1.4826 / np.sqrt(2.0)
    if scatter_mm < SCATTER * SCALE_SD_MM:
        return None
    on_grid = [_on_grid(robot, m, i) for i in joints]
    if all(on_grid) and _wanders(m, base, firsts, seconds):
        return None
    joint_deg = np.degrees(
        scatter_mm / float(np.sqrt(np.nanmean(np.sum(by_joint_mm(robot, m) ** 2, axis=1))))
    )
    if joint_deg > 10 * robot.pulse_deg + 0.02:
        return None
    return Mistake(
        "commanded_angles",
        phrase(
            "commanded_angles" if all(on_grid) else "commanded_angles_off_grid",
            columns=angle_columns(joints),
            scatter_um=scatter_mm * 1e3,
        ),
        (),
        "refused",
        "fresh" if file == "fresh" else "readings",
    )


def _visits(m: Measurements) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of visits of one position, each with the previous one, another position between them."""
    cells = np.round(np.degrees(m.theta) / SAME_PLACE_DEG).astype(int)
    firsts, seconds = [], []
    seen: dict[tuple[int, ...], list[int]] = {}
    for k in range(len(m)):
        near = [
            j
            for a in (-1, 0, 1)
            for b in (-1, 0, 1)
            for j in seen.get((int(cells[k, 0]) + a, int(cells[k, 1]) + b), [])
        ]
        near = [j for j in near if j < k - 1]
        if near:
            firsts.append(max(near))
            seconds.append(k)
        seen.setdefault((int(cells[k, 0]), int(cells[k, 1])), []).append(k)
    return np.array(firsts, dtype=np.intp), np.array(seconds, dtype=np.intp)


def _wanders(m: Measurements, base: Fitted, firsts: NDArray[np.intp], seconds: NDArray[np.intp]) -> bool:
    """Whether the residual of neighbours in time is similar: a drift, not the servos."""
    r = base.residual_mm - np.median(base.residual_mm)
    return bool(np.corrcoef(r[:-1], r[1:])[0, 1] > WANDERS)


def off_grid(robot: Robot, m: Measurements) -> bool:
    """Whether a joint's angles are clearly not whole pulses."""
    return any(not _on_grid(robot, m, i) for i in (0, 1))


def _on_grid(robot: Robot, m: Measurements, joint: int) -> bool:
    if robot.pulse_deg < 1e-3:
        return True  # the file's digits do not show it
    pulses = (np.degrees(m.theta[:, joint]) - robot.zero_at_deg[joint]) / robot.pulse_deg
    return bool(np.mean(np.abs(pulses - np.round(pulses)) > OFF_GRID) < 0.2)
