"""What the paper prints: Tables 2 to 9.  Zero offsets deg, lengths mm."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from station.records import Real

GROUPS = (1, 2, 3, 4, 5, 6)
MEASURED_GROUPS = (1, 2, 3)
"""Groups of the experiments (section 7)."""
ZERO_OFFSETS_DEG = ((2.0, -1.0), (-1.0, 0.5), (0.5, 0.25))
"""Table 2: groups 1 to 3, and again 4 to 6."""
GEOMETRIC_ERRORS_MM = (0.03, -0.02, -0.02, 0.01, 0.01, 0.02, -0.03, -0.02)
"""Table 2: e1x e1y e2x e2y L1 L2 l1 l2 of groups 1 to 3; groups 4 to 6 have a tenth."""
DRM_MM = (1.0, 0.5)
TOLERANCE_MM = (0.03, 0.003)
"""What a robot file would say of e, L, l: groups 1 to 3, and 4 to 6."""
KAPPA_1 = 475.34
KAPPA_M = 472.54


class HomeRow(NamedTuple):
    """A group of Table 3 or 7."""

    compensation_deg: tuple[float, float]
    delta_deg: tuple[float, float]
    before_mm: float
    after_mm: float


TABLE_3 = (
    HomeRow((2.033, -0.957), (0.033, 0.043), 10.933, 0.402),
    HomeRow((-1.049, 0.463), (0.049, 0.037), 5.482, 0.423),
    HomeRow((0.536, 0.297), (0.036, 0.047), 3.796, 0.434),
    HomeRow((2.024, -0.978), (0.024, 0.022), 10.896, 0.228),
    HomeRow((-1.025, 0.474), (0.025, 0.026), 5.5195, 0.256),
    HomeRow((0.476, 0.225), (0.024, 0.025), 3.798, 0.239),
)
TABLE_4_BEFORE_MM = (12.906, 6.418, 4.672, 12.868, 6.455, 4.663)
TABLE_4_AFTER_MM = (0.493, 0.531, 0.533, 0.279, 0.314, 0.293)
TABLE_5_MM = ((0.069, 0.040), (0.074, 0.045), (0.071, 0.042), (0.044, 0.022), (0.051, 0.028), (0.047, 0.024))
TABLE_6 = (472.47, 472.49, 472.49, 472.50, 472.51, 472.50)
TABLE_7 = (
    HomeRow((1.929, -0.924), (0.071, 0.076), 12.062, 0.732),
    HomeRow((-0.935, 0.572), (0.065, 0.072), 6.964, 0.605),
    HomeRow((0.569, 0.175), (0.069, 0.075), 4.945, 0.711),
)
TABLE_8_MM = ((0.842, 0.592), (0.835, 0.576), (0.852, 0.583))
TABLE_9_BEFORE_MM = (16.901, 8.326, 5.448)
TABLE_9_AFTER_MM = (0.847, 0.623, 0.825)


def true_errors(group: int) -> Real:
    """(12,) deviations of one group of Table 2 in the order of `station.five_bar.error_model`, rad and mm."""
    dtheta = np.radians(ZERO_OFFSETS_DEG[(group - 1) % 3])
    share = 1.0 if group <= 3 else 0.1
    return np.concatenate([dtheta, np.array(GEOMETRIC_ERRORS_MM) * share, DRM_MM])
