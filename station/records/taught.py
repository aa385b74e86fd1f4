"""Taught joint positions, and their translation to new zeros."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Sequence

from station.errors import InputRefused
from station.records.record import Record
from station.records.sections import Finite, Section

COLUMNS = ("position", "theta1_deg", "theta2_deg")
IN_RADIANS = {"theta1_rad": "theta1_deg", "theta2_rad": "theta2_deg"}
SEPARATORS = (",", ";", "\t")
DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d+([eE][+-]?\d+)?\s*")


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
    """Positions from a CSV file, its columns in any order; other columns are ignored.

    Cells are separated by comma, semicolon or tab; between the last two a decimal comma is read.

    :raises InputRefused: with row and column.
    """
    text = text.removeprefix("\ufeff").lstrip("\r\n")
    separator = _separator(text.partition("\n")[0])
    rows = csv.reader(io.StringIO(text), delimiter=separator)
    columns = _columns(next(rows, []), source)
    out = []
    for number, row in enumerate((row for row in rows if any(cell.strip() for cell in row)), start=1):
        cells = {name: row[at] if at < len(row) else None for name, at in columns.items()}
        out.append(_position(cells, f"{source}: row {number}", decimal_comma=separator != ","))
    if not out:
        raise InputRefused(f"{source}: no positions.")
    return tuple(out)


def _separator(header: str) -> str:
    """The separator with which the first line has the most columns."""
    return max(SEPARATORS, key=header.count)


def _columns(header: Sequence[str], source: str) -> dict[str, int]:
    """Index of each needed column; angles may be in radians."""
    names = [name.strip().lower() for name in header]
    known = {*COLUMNS, *IN_RADIANS}
    meaning = [IN_RADIANS.get(name, name) for name in names if name in known]
    missing = [name for name in COLUMNS if name not in meaning]
    if missing:
        raise InputRefused(f"{source}: column {missing[0]} is missing; {', '.join(COLUMNS)} are needed.")
    twice = [name for name in COLUMNS if meaning.count(name) > 1]
    if twice:
        raise InputRefused(f"{source}: column {twice[0]} is given twice; leave one of them out.")
    return {name: names.index(name) for name in names if name in known}


def _position(cells: dict[str, str | None], where: str, *, decimal_comma: bool) -> TaughtPosition:
    angles = {}
    for name in COLUMNS[1:]:
        column = name if name in cells else next(own for own, of in IN_RADIANS.items() if of == name)
        value = _number(cells[column], decimal_comma=decimal_comma)
        if value is None:
            raise InputRefused(f"{where}: column {column} needs a number (given: {cells[column] or ''!r}).")
        angles[name] = value if column == name else math.degrees(value)
    return TaughtPosition(position=cells["position"] or "", **angles)


def _number(cell: str | None, *, decimal_comma: bool) -> float | None:
    text = cell or ""
    if decimal_comma and DECIMAL_COMMA.fullmatch(text):
        text = text.replace(",", ".")
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


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
