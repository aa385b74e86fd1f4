"""Target positions as a CSV file, and the joint commands that go back."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from station.errors import InputRefused
from station.kinematics import Complex, Real
from station.measurement_file import Table, approaches, read_table

REQUIRED = ("x_mm", "y_mm")
APPROACH = ("approach1", "approach2")
OPTIONAL = (*APPROACH, "temperature_c", "payload_kg")


@dataclass(frozen=True)
class Targets:
    """K places to bring P to."""

    table: Table
    place: Complex
    """(K,) mm"""
    approach: Real
    """(K, 2) sign of each joint's last motion, 0 not given."""
    temperature_c: Real | None
    payload_kg: Real | None

    def __len__(self) -> int:
        return len(self.place)

    def refuse(self, row: int, column: str, what: str) -> InputRefused:
        """Says where in the file."""
        return self.table.refuse(row, column, what)


def read_targets(path: Path) -> Targets:
    """:raises InputRefused: anything malformed, with row and column."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputRefused(f"{path} cannot be read: {error.strerror}.") from error
    table = read_table(content, REQUIRED, OPTIONAL, path.name)
    return Targets(
        table,
        table.numbers("x_mm") + 1j * table.numbers("y_mm"),
        np.column_stack([approaches(table, name) for name in APPROACH]),
        table.optional_numbers("temperature_c"),
        table.optional_numbers("payload_kg"),
    )


def commands_csv(targets: Targets, theta: Real) -> str:
    """The known columns of the targets as given, then theta1_deg, theta2_deg of theta (K, 2), rad."""
    kept = [name for name in (*REQUIRED, *OPTIONAL) if targets.table.has(name)]
    given = [targets.table.text(name) for name in kept]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*kept, "theta1_deg", "theta2_deg"])
    for k, angles in enumerate(np.degrees(theta)):
        writer.writerow([*(cells[k] for cells in given), *(f"{a:.6f}" for a in angles)])
    return out.getvalue()
