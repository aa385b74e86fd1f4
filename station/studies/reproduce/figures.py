"""Data of Fig. 5 and 8; Fig. 9 and 12 come with the trials (`station.studies.reproduce.tables`)."""

from __future__ import annotations

from typing import Any

import numpy as np

from station.five_bar import HOME, NAMES, SIZE, Robot, forward, perturbed, pose, position_jacobian
from station.published import conditioning

FIRST_LIMB = ("dtheta1", "e1x", "e1y", "L1", "l1")
"""By symmetry the second limb's are the same (section 3)."""
ANGLE_DEG = 2.0
LENGTH_MM = 0.1
POINTS = 21
FIG_8_N = range(3, 11)


def fig5(robot: Robot) -> list[dict[str, Any]]:
    """Distance error of P_0 against each source error of the first limb, others zero.

    {parameter, unit, per_unit_mm, x: [...], error_mm: [...]}; per_unit_mm is the slope at zero (eq. 12).
    """
    geometry = robot.geometry
    home = forward(geometry, HOME[None])
    jacobian = position_jacobian(geometry, pose(geometry, HOME[None]))[0]
    out = []
    for name in FIRST_LIMB:
        i = NAMES.index(name)
        angle = name.startswith("dtheta")
        unit = np.radians(1.0) if angle else 1.0
        shown = np.linspace(-1.0, 1.0, POINTS) * (ANGLE_DEG if angle else LENGTH_MM)
        errors = []
        for value in shown:
            p = np.zeros(SIZE)
            p[i] = value * unit
            moved = forward(perturbed(geometry, p), HOME[None] + p[:2])
            errors.append(float(np.abs(moved - home)[0]))
        out.append(
            {
                "parameter": name,
                "unit": "deg" if angle else "mm",
                "per_unit_mm": float(np.linalg.norm(jacobian[:, i]) * unit),
                "x": shown.tolist(),
                "error_mm": errors,
            }
        )
    return out


def fig8(robot: Robot) -> list[dict[str, float]]:
    """{n, kappa_1, kappa_m, epsilon} (eq. 31)."""
    rows = [conditioning(robot, n) for n in FIG_8_N]
    return [{"n": r.n, "kappa_1": r.kappa_1, "kappa_m": r.kappa_m, "epsilon": r.epsilon} for r in rows]
