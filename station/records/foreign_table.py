"""Tables in common formats: text or spreadsheet, with or without a header, units and lines before it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from station.errors import InputRefused
from station.records.foreign_numbers import is_number, signs_of
from station.records.foreign_sheet import OLD_SPREADSHEET, SPREADSHEET, read_spreadsheet
from station.records.foreign_text import read_text
from station.records.units import unit_in

_MOSTLY = 0.5
"""Minimum share of numbers in the cells of a row of readings."""
Numbered = tuple[int, list[str]]
"""A row and its number in the file, from 1."""


@dataclass(frozen=True)
class ForeignTable:
    """The cells of a file, numbers with a decimal point."""

    source: str
    header: tuple[str, ...]
    """Names of the columns; "1", "2", ... where the file has none."""
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]
    """Number of each row in the file, from 1."""
    separator: str
    decimal: str
    named: bool = True
    """Whether the file itself names the columns."""
    units: tuple[str, ...] = ()
    """Units of the columns, if a row below the names contains them."""

    def column(self, name: str) -> list[str]:
        """The cells of a column.  :raises InputRefused: there is no such column, or it occurs twice."""
        places = [i for i, own in enumerate(self.header) if own == name]
        if len(places) != 1:
            what = "is missing" if not places else f"appears {len(places)} times"
            there = ", ".join(self.header)
            raise InputRefused(f"{self.source}: column {name!r} {what}; there are {there}.")
        return [row[places[0]] for row in self.rows]

    def unit(self, name: str) -> str:
        """Unit of a column, from the row of units; empty if there is none."""
        return self.units[self.header.index(name)] if self.units else ""


def read_foreign(
    content: bytes,
    source: str,
    *,
    header: bool | None = None,
    separator: str = "",
    decimal: str = "",
    sheet: str = "",
) -> ForeignTable:
    """Rows of a text file or spreadsheet; options that are not given are detected.

    :param header: whether a row names the columns; None: if the first row is not all numbers
    :raises InputRefused: the file is not a table, or its rows have different lengths.
    """
    if content.startswith(OLD_SPREADSHEET):
        raise InputRefused(
            f"{source} is an .xls file or has a password; save it as .xlsx without one, or as .csv."
        )
    if content.startswith(SPREADSHEET):
        every, separator = list(enumerate(read_spreadsheet(content, source, sheet), start=1)), ""
        rows = [(line, [cell.strip() for cell in row]) for line, row in every if any(row)]
    else:
        rows, separator = read_text(content, source, separator)
    above, body = _parted(rows, source)
    if not above and (header or (header is None and _counts_columns(body[0][1]))):
        above, body = [body[0]], body[1:]
    width = len(body[0][1]) if body else 0
    names, units = _names(above, width) if header is not False else ((), ())
    empty = {i for i in range(width) if not any(row[i] for _, row in body) and not (names and names[i])}
    twice = _repeated(names, [row for _, row in body])
    kept = [i for i in range(width) if i not in empty | twice]
    signs = signs_of((cell for _, row in body for cell in row), decimal)
    return ForeignTable(
        source,
        tuple(names[i] for i in kept) if names else tuple(str(i + 1) for i in kept),
        tuple(tuple(signs.plain(row[i]) for i in kept) for _, row in body),
        tuple(line for line, _ in body),
        separator,
        signs.decimal,
        bool(names),
        tuple(units[i] for i in kept) if units else (),
    )


def _parted(rows: list[Numbered], source: str) -> tuple[list[Numbered], list[Numbered]]:
    """The lines above the readings, and the readings.  :raises InputRefused: there is no table of numbers."""
    numeric = [len(row) for _, row in rows if _of_numbers(row)]
    if not numeric:
        raise InputRefused(f"{source}: no rows of numbers were found.")
    width = Counter(numeric).most_common(1)[0][0]
    first = next(k for k, (_, row) in enumerate(rows) if len(row) == width and _of_numbers(row))
    for line, row in rows[first:]:
        if len(row) != width:
            raise InputRefused(
                f"{source}: row {line} has {len(row)} fields where the others have {width}; "
                "the file is truncated or the separator is wrong."
            )
    return rows[:first], rows[first:]


def _of_numbers(row: list[str]) -> bool:
    filled = [cell for cell in row if cell]
    return sum(map(is_number, filled)) > _MOSTLY * len(filled)


def _counts_columns(row: list[str]) -> bool:
    """Whether a row only numbers the columns."""
    return any(row == [str(k + first) for k in range(len(row))] for first in (0, 1))


def _names(above: list[Numbered], width: int) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names and units of the columns, from the lines directly above the readings; empty if there are none."""
    fitting = [cells for _, row in above[-3:] if len(cells := _fitted(row, width)) == width]
    units: tuple[str, ...] = ()
    if len(fitting) > 1 and all(unit_in(cell) or not cell.strip("[]()- ") for cell in fitting[-1]):
        units = tuple(unit_in(cell) for cell in fitting.pop())
    return (tuple(fitting[-1]) if fitting else ()), units


def _repeated(names: tuple[str, ...], rows: list[list[str]]) -> set[int]:
    """Columns that have name and cells of an earlier one: exports repeat a selected channel."""
    return {
        i
        for i, name in enumerate(names)
        if name and (first := names.index(name)) < i and all(row[i] == row[first] for row in rows)
    }


def _fitted(row: list[str], width: int) -> list[str]:
    """As long as a row of readings: the first column may be unnamed, the last may be empty."""
    if len(row) == width + 1 and not row[-1]:
        return row[:-1]
    return ["", *row] if len(row) == width - 1 else row
