"""The method as the paper prints it (sections 4 and 5)."""

from __future__ import annotations

from station.published.method import (
    boundary_positions,
    compensation_accuracy,
    full_identification_matrix,
    identification_matrix,
    identify,
)
from station.published.positions import conditioning, positions_per_edge
from station.published.run import MAX_PASSES, MU_0_DEG, PublishedRun

__all__ = [
    "MAX_PASSES",
    "MU_0_DEG",
    "PublishedRun",
    "boundary_positions",
    "compensation_accuracy",
    "conditioning",
    "full_identification_matrix",
    "identification_matrix",
    "identify",
    "positions_per_edge",
]
