"""Taught joint positions, and their translation to new zeros."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence

from pydantic import ValidationError

from station.errors import InputRefused
from station.records.record import Record
from station.records.sections import Finite, Section, said

COLUMNS = ("position", "theta1_deg", "theta2_deg")


class TaughtPosition(Section):
    """One position as stored in the robot's controller."""

    position: str
    theta1_deg: Finite
    theta2_deg: Finite


class TranslatedPosition(Record):
    """The same physical position under the present zeros."""

    position: str
    theta1_deg: float
    theta2_deg: float
    u95_mm: float | None
    """With 95 % probability the platform is within this of its earlier position; null if the linkage cannot
    close.
    """
    within_limits: bool
    """False near a limit of the workspace or of a joint, or where the distal links are nearly in line."""


def read_taught(text: str, source: str) -> tuple[TaughtPosition, ...]:
    """Positions from a CSV file; other columns are ignored. :raises InputRefused: with row and column."""
    rows = csv.DictReader(io.StringIO(text.removeprefix("\ufeff")))
    missing = [name for name in COLUMNS if name not in (rows.fieldnames or ())]
    if missing:
        raise InputRefused(f"{source}: column {missing[0]} is missing; {', '.join(COLUMNS)} are needed.")
    out = []
    for number, row in enumerate(rows, start=1):
        try:
            out.append(TaughtPosition.model_validate({name: row[name] for name in COLUMNS}))
        except ValidationError as error:
            first = error.errors()[0]
            where = f"{source}: row {number}: column {first['loc'][0]}"
            raise InputRefused(f"{where}: {said(first).lower()} (given: {first['input']!r}).") from error
    if not out:
        raise InputRefused(f"{source}: no positions.")
    return tuple(out)


def translated_to_csv(positions: Sequence[TranslatedPosition]) -> str:
    """The same columns, with the results for each position."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*COLUMNS, "u95_mm", "within_limits"])
    for p in positions:
        u95 = "" if p.u95_mm is None or not math.isfinite(p.u95_mm) else f"{p.u95_mm:.4f}"
        angles = (f"{p.theta1_deg:.6f}", f"{p.theta2_deg:.6f}")
        writer.writerow([p.position, *angles, u95, str(p.within_limits).lower()])
    return out.getvalue()
