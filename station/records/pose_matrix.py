"""Pose matrices: a rotation and a position as 12 or 16 numbers, row by row or column by column."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from station.errors import InputRefused
from station.records.foreign_numbers import has_value

ROTATION = 1e-2
"""Maximum deviation of a printed rotation matrix from an orthonormal one."""


def position_columns(cells: Sequence[Sequence[str]], where: str) -> tuple[int, int, int]:
    """Which of 12 or 16 columns are x, y and z.  :raises InputRefused: they do not form a pose."""
    try:
        values = np.array([[float(c) if has_value(c) else np.nan for c in column] for column in cells]).T
    except ValueError:
        raise InputRefused(f"{where}: a cell of the pose matrix is not a number.") from None
    count = values.shape[1]
    # rows without a pose: the target was lost
    values = values[np.isfinite(values).all(axis=1) & values.any(axis=1)]
    for by_row in (True, False):
        order = np.arange(count)
        matrix = order.reshape(-1, 4) if by_row else order.reshape(4, -1).T
        rotation = values[:, matrix[:3, :3]]
        off = np.abs(np.einsum("kij,klj->kil", rotation, rotation) - np.eye(3))
        closed = count == 12 or np.allclose(values[:, matrix[3]], [0.0, 0.0, 0.0, 1.0])
        if closed and len(off) and off.max() < ROTATION:
            x, y, z = (int(i) for i in matrix[:3, 3])
            return x, y, z
    raise InputRefused(
        f"{where}: the columns are no pose matrix: neither row by row nor column by column do they hold "
        "a rotation."
    )
