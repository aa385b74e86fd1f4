"""Array types and joint angles that every package uses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complexfloating]


Real = NDArray[np.floating]


Angles = tuple[float, float]


Index = NDArray[np.intp]

Flags = NDArray[np.bool_]


LARGEST_ID = 2**63 - 1
"""SQLite's largest row id; the database accepts no larger number."""
