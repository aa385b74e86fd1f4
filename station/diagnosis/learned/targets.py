"""Target positions from a CSV file or the rows of a request, and the joint commands for them."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from station.errors import FieldRefused, InputRefused
from station.records import Complex, Phrase, Real, Table, approaches, content_of, phrase, read_table

REQUIRED = ("x_mm", "y_mm")
APPROACH = ("approach1", "approach2")
OPTIONAL = (*APPROACH, "temperature_c", "payload_kg")


class Source(Protocol):
    """The origin of targets, for messages."""

    def refusal(self, row: int, column: str, what: Phrase) -> InputRefused:
        """A refusal that names the position in the source."""


class TargetRefused(FieldRefused):
    """A target of a request; `said` is the refusal by its code, for other languages."""

    def __init__(self, field: str, said: Phrase) -> None:
        super().__init__(field, said.text())
        self.said = said


class Rows:
    """The targets of a request."""

    def refusal(self, row: int, column: str, what: Phrase) -> InputRefused:
        """Names the target by its index; of several columns the field is the first."""
        field = f"targets.{row}.{column.partition(',')[0]}"
        return TargetRefused(field, phrase("target_refused", number=row, column=column, why=what))


@dataclass(frozen=True)
class File:
    """The targets of a file."""

    table: Table

    def refusal(self, row: int, column: str, what: Phrase) -> InputRefused:
        """Names the row of the file."""
        return self.table.refuse(row, column, what.text())


@dataclass(frozen=True)
class Targets:
    """K target positions of P."""

    source: Source
    place: Complex
    """(K,) mm"""
    approach: Real
    """(K, 2) sign of each joint's last motion, 0 not given."""
    temperature_c: Real | None
    payload_kg: Real | None

    def __len__(self) -> int:
        return len(self.place)

    def refusal(self, row: int, column: str, what: Phrase) -> InputRefused:
        """A refusal that names the position in the source."""
        return self.source.refusal(row, column, what)


def targets_of(rows: Sequence[Mapping[str, float | None]]) -> Targets:
    """The rows of a request, each validated already, with the columns of the file.

    :raises InputRefused: only some of them have a temperature or payload.
    """
    source = Rows()

    def optional(column: str) -> Real | None:
        missing = [k for k, row in enumerate(rows) if row[column] is None]
        if len(missing) == len(rows):
            return None
        if missing:
            raise source.refusal(missing[0], column, phrase("others_have_it"))
        return numbers(column)

    def numbers(column: str) -> Real:
        return np.array([row[column] for row in rows], dtype=float)

    return Targets(
        source,
        numbers("x_mm") + 1j * numbers("y_mm"),
        np.column_stack([numbers(name) for name in APPROACH]),
        optional("temperature_c"),
        optional("payload_kg"),
    )


def read_targets(path: Path) -> tuple[Table, Targets]:
    """:raises InputRefused: the file is malformed; the error gives row and column."""
    table = read_table(content_of(path), REQUIRED, OPTIONAL, path.name)
    targets = Targets(
        File(table),
        table.numbers("x_mm") + 1j * table.numbers("y_mm"),
        np.column_stack([approaches(table, name) for name in APPROACH]),
        table.optional_numbers("temperature_c"),
        table.optional_numbers("payload_kg"),
    )
    return table, targets


def commands_csv(table: Table, theta: Real) -> str:
    """The known columns of the targets as given, then theta1_deg, theta2_deg of theta (K, 2), rad."""
    kept = [name for name in (*REQUIRED, *OPTIONAL) if table.has(name)]
    given = [table.text(name) for name in kept]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*kept, "theta1_deg", "theta2_deg"])
    for k, angles in enumerate(np.degrees(theta)):
        writer.writerow([*(cells[k] for cells in given), *(f"{a:.6f}" for a in angles)])
    return out.getvalue()
