"""Conversion of a foreign file to the contract's form, by its column map."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import TypeVar

from station.errors import InputRefused
from station.records.column_map import ROW_NUMBER, ColumnMap, FromColumn, FromColumns, Group, Name, Source
from station.records.foreign_numbers import has_value
from station.records.foreign_table import ForeignTable, read_foreign
from station.records.measurement_file import Columns
from station.records.pose_matrix import position_columns
from station.records.units import TO_CONTRACT, Unit

POSE = "pose"
"""In a map: the 12 or 16 numbers of a pose matrix, of which the position is used."""
CLOCKS = (
    "%d.%m.%Y %H:%M:%S.%f", "%d.%m.%Y %H:%M:%S", "%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S", "%H:%M:%S.%f",
    "%H:%M:%S",
)  # fmt: skip
"""Time formats, beside those of ISO 8601."""
T = TypeVar("T")
Cells = dict[str, list[str]]
"""Cells by the contract's name of the column."""


@dataclass(frozen=True)
class Translated:
    """The converted file, to be read like any measurement file."""

    content: bytes
    names: tuple[str, ...]
    """Names of its columns."""
    lost: int
    """Readings that are excluded because the instrument had lost its target."""


def translated(content: bytes, mapping: ColumnMap | None, columns: Columns, source: str) -> Translated:
    """The file in the contract's form; every row retains its line number for refusals.

    :raises InputRefused: the file is not a table, a column is missing, or a cell is not a number.
    """
    m = mapping or ColumnMap()
    table = read_foreign(
        content, source, header=m.header, separator=m.separator, decimal=m.decimal, sheet=m.sheet
    )
    cells: Cells = {}
    if not m.columns:
        cells = {name: table.column(name) for name in table.header if name}
    points: list[Cells] = []
    for name, given in m.columns.items():
        found = _cells(table, name, given, columns)
        cells |= found[0] if len(found) == 1 else {}
        points = found if len(found) > 1 else points
    for name in ("reading", "t_s"):
        cells.setdefault(name, [str(k + 1) for k in range(len(table.rows))])
    return _written(table, [cells] if not points else _at_points(cells, points), columns, m.missing)


def _at_points(cells: Cells, points: Sequence[Cells]) -> list[Cells]:
    """All columns of each measured point; every reading has a separate id."""
    return [
        {
            **cells,
            **point,
            "reading": [f"{own}/{k + 1}" for own in cells["reading"]],
            "mount": [str(k + 1)] * len(cells["reading"]),
        }
        for k, point in enumerate(points)
    ]


def _written(
    table: ForeignTable, parts: Sequence[Cells], columns: Columns, missing: list[float] | None
) -> Translated:
    """Row by row, the points of a row one after the other."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    names = tuple(parts[0])
    out.write("\n" * max(table.lines[0] - 2, 0))
    writer.writerow(names)
    line, lost = max(table.lines[0] - 2, 0) + 1, 0
    axes = [name for name in columns.tracker if name in names]
    axes = axes or [name for name in (columns.distance,) if name in names]
    for k in range(len(table.rows)):
        for part in parts:
            if columns.either and axes and _lost([part[name][k] for name in axes], missing):
                lost += 1
                continue
            before = max(table.lines[k] - 1 - line, 0)
            out.write("\n" * before)
            writer.writerow([part[name][k] for name in names])
            line += before + 1
    return Translated(out.getvalue().encode(), names, lost)


def _lost(position: list[str], missing: list[float] | None) -> bool:
    """Whether the position of a row contains the value for a missing one."""
    if not all(map(has_value, position)):
        return True
    try:
        at = [float(cell) for cell in position]
    except ValueError:
        return False
    return at == (missing if missing is not None else [0.0] * len(at))


def _cells(table: ForeignTable, name: str, given: Source | Group, columns: Columns) -> list[Cells]:
    """One column of the contract, or all of a group; several if several points were measured."""
    groups = {"theta_deg": columns.theta, "approach": columns.approach, "tracker_mm": columns.tracker}
    known = (*columns.required, *columns.optional)
    where = f"{table.source}: [columns.{name}]"
    if name == POSE and columns.tracker:
        names, unit = _flat(given, where), given.unit if isinstance(given, FromColumns) else None
        found = position_columns([table.column(str(n)) for n in names], where)
        return _group(
            table, where, columns.tracker, FromColumns(columns=[names[i] for i in found], unit=unit)
        )
    if name in groups:
        if isinstance(given, list):
            given = FromColumns(columns=given)
        if not isinstance(given, FromColumns):
            raise InputRefused(f"{where} needs a list of columns, one for each of {', '.join(groups[name])}.")
        return _group(table, where, groups[name], given)
    if name not in known:
        raise InputRefused(
            f"{where} is not a column that is read; known are {', '.join((*groups, POSE, *known))}."
        )
    if given == ROW_NUMBER:
        return [{name: [str(k + 1) for k in range(len(table.rows))]}]
    if isinstance(given, str | int):
        given = FromColumn(column=given)
    if not isinstance(given, FromColumn):
        raise InputRefused(f"{where} needs one column.")
    return [{name: _column(table, name, given)}]


def _flat(given: Source | Group, where: str) -> list[Name]:
    listed = given.columns if isinstance(given, FromColumns) else given
    names = [name for name in listed if not isinstance(name, list)] if isinstance(listed, list) else []
    if len(names) not in (12, 16):
        raise InputRefused(f"{where} needs a list of the 12 or 16 columns of the matrix.")
    return names


def _group(table: ForeignTable, where: str, own: Sequence[str], given: FromColumns) -> list[Cells]:
    listed = given.columns or []
    nested = [part for part in listed if isinstance(part, list)]
    if nested:
        flat = [name for name in listed if not isinstance(name, list)]
        if flat:
            raise InputRefused(f"{where} has lists and names; give one list of columns for each point.")
        return [
            point
            for part in nested
            for point in _group(table, where, own, given.model_copy(update={"columns": part}))
        ]
    first, second = given.difference or ([name for name in listed if not isinstance(name, list)], None)
    if len(first) != len(own) or (second is not None and len(second) != len(first)):
        raise InputRefused(f"{where} has {len(first)} columns where {len(own)} are needed: {', '.join(own)}.")
    units: Sequence[Unit | None] = _each(given.unit or [None] * len(own), len(own), f"{where} unit")
    factors = _each(given.factor, len(own), f"{where} factor")
    out: Cells = {}
    for i, name in enumerate(own):
        one = FromColumn(
            column=first[i] if second is None else None,
            difference=None if second is None else (first[i], second[i]),
            unit=units[i],
            factor=factors[i],
        )
        out[name] = _column(table, name, one)
    return [out]


def _each(given: T | Sequence[T], count: int, where: str) -> Sequence[T]:
    """One item for each column."""
    if isinstance(given, str) or not isinstance(given, Sequence):
        return [given] * count
    if len(given) != count:
        raise InputRefused(f"{where} has {len(given)} values for {count} columns; give one, or one for each.")
    return given


def _column(table: ForeignTable, name: str, given: FromColumn) -> list[str]:
    if given.constant is not None:
        return [str(given.constant)] * len(table.rows)
    scale = _factor(table, name, given.unit, given.factor)
    if given.difference is not None:
        first, second = (table.column(str(column)) for column in given.difference)
        pairs = zip(first, second, strict=True)
        return [_difference(table, name, k, a, b, scale) for k, (a, b) in enumerate(pairs)]
    if given.column is None:
        raise InputRefused(f"{table.source}: [columns.{name}] needs column, difference or constant.")
    cells = table.column(str(given.column))
    if name == "t_s":
        return seconds(table, cells, scale)
    return cells if scale == 1.0 else [_scaled(table, name, k, cell, scale) for k, cell in enumerate(cells)]


def _factor(table: ForeignTable, name: str, unit: Unit | None, factor: float) -> float:
    if unit in (None, "counts"):
        return factor
    known = TO_CONTRACT.get(name.rpartition("_")[2], {})
    if unit not in known:
        can = ", ".join(known) or "none"
        raise InputRefused(f"{table.source}: [columns.{name}] cannot be in {unit}; its units: {can}.")
    return known[unit] * factor


def _difference(table: ForeignTable, name: str, k: int, a: str, b: str, scale: float) -> str:
    if not has_value(a) or not has_value(b):
        return ""
    return repr((_number(table, name, k, a) - _number(table, name, k, b)) * scale)


def _scaled(table: ForeignTable, name: str, k: int, cell: str, scale: float) -> str:
    return repr(_number(table, name, k, cell) * scale) if has_value(cell) else ""


def _number(table: ForeignTable, name: str, k: int, cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        raise InputRefused(
            f"{table.source}: row {table.lines[k]}, for {name}: {cell!r} is not a number; "
            "check separator and decimal sign."
        ) from None


def seconds(table: ForeignTable, cells: list[str], scale: float) -> list[str]:
    """Seconds since the first row, from numbers or from dates with times."""
    try:
        times = [float(cell) * scale for cell in cells]
    except ValueError:
        times = [_clock(table, k, cell) for k, cell in enumerate(cells)]
    return [repr(time - times[0]) for time in times]


def _clock(table: ForeignTable, k: int, cell: str) -> float:
    text = cell.replace(",", ".")
    for way in (None, *CLOCKS):
        try:
            moment = datetime.fromisoformat(text) if way is None else datetime.strptime(text, way)
        except ValueError:
            continue
        start = datetime(1970, 1, 1, tzinfo=moment.tzinfo)
        return (moment - start).total_seconds()
    raise InputRefused(
        f"{table.source}: row {table.lines[k]}, for t_s: {cell!r} is neither a number nor a time like "
        "2026-11-27T10:00:00; leave t_s out of the map if the file has no usable time."
    )
