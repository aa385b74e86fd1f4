"""The column map: which columns of a foreign file are which of the contract's, and in what unit."""

from __future__ import annotations

import csv
import io
import math
import tomllib
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, ValidationError

from station.errors import InputRefused
from station.records.foreign_table import ForeignTable, read_foreign
from station.records.measurement_file import Columns
from station.records.sections import Finite, Section, refusal

Unit = Literal["rad", "deg", "m", "mm", "in", "s", "ms", "min", "h", "C", "kg", "g", "counts"]
TO_CONTRACT: dict[str, dict[str, float]] = {
    "deg": {"deg": 1.0, "rad": 180.0 / math.pi},
    "mm": {"mm": 1.0, "m": 1e3, "in": 25.4},
    "s": {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0},
    "c": {"C": 1.0},
    "kg": {"kg": 1.0, "g": 1e-3},
}
"""Unit in a column's name -> factor of each unit that a file may have."""
ROW_NUMBER = "row number"
AXES = ("x", "y", "z")


class FromColumn(Section):
    """One column of the file, or two of which the second is taken away, or a constant."""

    column: str | int | None = None
    difference: tuple[str | int, str | int] | None = None
    constant: str | float | None = None
    unit: Unit | None = None
    """By default that of the contract."""
    factor: Finite = 1.0
    """Multiplies every number: a sign, or the unit's counts."""


class FromColumns(Section):
    """Several columns of a kind at once: all joints, or x, y, z."""

    columns: Annotated[list[str | int], Field(min_length=1)] | None = None
    difference: tuple[list[str | int], list[str | int]] | None = None
    unit: Unit | None = None
    factor: Finite = 1.0


Source = FromColumn | str | int
Group = FromColumns | list[str | int]


class ColumnMap(Section):
    """A file `MAP.toml`."""

    header: bool = True
    """Whether the first row names the columns; else columns are numbered from 1."""
    separator: str = ""
    decimal: Literal["", ".", ","] = ""
    missing: list[Finite] | None = None
    """What the file has in place of a position that was not measured; such rows are left out."""
    columns: dict[str, Source | Group] = Field(default_factory=dict)

    @classmethod
    def read(cls, path: Path) -> ColumnMap:
        """:raises InputRefused: missing, not TOML, or a key or value out of place."""
        try:
            with path.open("rb") as file:
                return cls.model_validate(tomllib.load(file))
        except OSError as error:
            raise InputRefused(f"Column map {path} cannot be read: {error.strerror}.") from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise InputRefused(f"Column map {path} is not valid TOML: {error}.") from error
        except ValidationError as error:
            raise refusal(error, str(path)) from error


def translated(content: bytes, mapping: ColumnMap | None, columns: Columns, source: str) -> tuple[bytes, int]:
    """The file as the contract has it, and how many of its rows had lost the target (0, 0, 0).

    :raises InputRefused: not a table, a column that is not there, a cell that is no number.
    """
    m = mapping or ColumnMap()
    table = read_foreign(content, source, header=m.header, separator=m.separator, decimal=m.decimal)
    cells: dict[str, list[str]] = {}
    if mapping is None or not m.columns:
        cells = {name: table.column(name) for name in table.header if name}
    for name, given in m.columns.items():
        cells |= _cells(table, name, given, columns)
    count = len(table.rows)
    for name in ("reading", "t_s"):
        cells.setdefault(name, [str(k + 1) for k in range(count)])
    axes = [name for name in columns.tracker if name in cells]
    lost = [_same(k, [cells[name] for name in axes], m.missing) for k in range(count)] if axes else []
    kept = [k for k in range(count) if not (lost and lost[k])]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(cells)
    writer.writerows([column[k] for column in cells.values()] for k in kept)
    return out.getvalue().encode(), count - len(kept)


def _same(k: int, axes: list[list[str]], missing: list[float] | None) -> bool:
    """Whether row k has at its position what stands for none."""
    try:
        at = [float(axis[k]) for axis in axes]
    except ValueError:
        return False
    return at == (list(missing) if missing is not None else [0.0] * len(at))


def _cells(table: ForeignTable, name: str, given: Source | Group, columns: Columns) -> dict[str, list[str]]:
    """One column of the contract, or all of a group: theta_deg, approach, tracker_mm."""
    groups = {"theta_deg": columns.theta, "approach": columns.approach, "tracker_mm": columns.tracker}
    known = (*columns.required, *columns.optional)
    where = f"{table.source}: [columns.{name}]"
    if name in groups:
        if isinstance(given, list):
            given = FromColumns(columns=given)
        if not isinstance(given, FromColumns):
            raise InputRefused(f"{where} needs a list of columns, one for each of {', '.join(groups[name])}.")
        first, second = given.difference or (given.columns or [], None)
        if len(first) != len(groups[name]) or (second is not None and len(second) != len(first)):
            raise InputRefused(f"{where} has {len(first)} columns where {len(groups[name])} are needed.")
        out = {}
        for i, own in enumerate(groups[name]):
            one = FromColumn(
                column=first[i] if second is None else None,
                difference=None if second is None else (first[i], second[i]),
                unit=given.unit,
                factor=given.factor,
            )
            out[own] = _column(table, own, one)
        return out
    if name not in known:
        raise InputRefused(f"{where} is not a column that is read; known are {', '.join((*groups, *known))}.")
    if given == ROW_NUMBER:
        return {name: [str(k + 1) for k in range(len(table.rows))]}
    if isinstance(given, str | int):
        given = FromColumn(column=given)
    if not isinstance(given, FromColumn):
        raise InputRefused(f"{where} needs one column.")
    return {name: _column(table, name, given)}


def _column(table: ForeignTable, name: str, given: FromColumn) -> list[str]:
    if given.constant is not None:
        return [str(given.constant)] * len(table.rows)
    scale = _factor(table, name, given)
    if given.difference is not None:
        first, second = (table.column(str(column)) for column in given.difference)
        pairs = zip(_numbers(table, name, first), _numbers(table, name, second), strict=True)
        return [repr((a - b) * scale) for a, b in pairs]
    if given.column is None:
        raise InputRefused(f"{table.source}: [columns.{name}] needs column, difference or constant.")
    cells = table.column(str(given.column))
    return cells if scale == 1.0 else [repr(v * scale) for v in _numbers(table, name, cells)]


def _factor(table: ForeignTable, name: str, given: FromColumn) -> float:
    if given.unit in (None, "counts"):
        return given.factor
    own = name.rpartition("_")[2]
    known = TO_CONTRACT.get(own, {})
    if given.unit not in known:
        can = ", ".join(known) or "none"
        raise InputRefused(f"{table.source}: [columns.{name}] cannot be in {given.unit}; its units: {can}.")
    return known[given.unit] * given.factor


def _numbers(table: ForeignTable, name: str, cells: list[str]) -> list[float]:
    out = []
    for k, cell in enumerate(cells):
        try:
            out.append(float(cell))
        except ValueError:
            raise InputRefused(
                f"{table.source}: row {k + 2}, for {name}: {cell!r} is not a number; "
                "check separator and decimal sign."
            ) from None
    return out
