"""Tables as people have them: any separator, decimal comma, spreadsheets, with or without a header."""

from __future__ import annotations

import csv
import io
from collections import Counter
from dataclasses import dataclass

from station.errors import InputRefused

SEPARATORS = ";\t|,"
SPREADSHEET = b"PK\x03\x04"
"""An .xlsx file is a zip archive."""


@dataclass(frozen=True)
class ForeignTable:
    """The cells of a file, decimal points put right."""

    source: str
    header: tuple[str, ...]
    """Names of the columns; "1", "2", ... where the file has none."""
    rows: tuple[tuple[str, ...], ...]
    separator: str
    decimal: str

    def column(self, name: str) -> list[str]:
        """The cells of a column.  :raises InputRefused: there is no such column, or it is there twice."""
        places = [i for i, own in enumerate(self.header) if own == name]
        if len(places) != 1:
            what = "is missing" if not places else f"appears {len(places)} times"
            there = ", ".join(self.header)
            raise InputRefused(f"{self.source}: column {name!r} {what}; there are {there}.")
        return [row[places[0]] for row in self.rows]


def read_foreign(
    content: bytes, source: str, *, header: bool = True, separator: str = "", decimal: str = ""
) -> ForeignTable:
    """Rows of a text file or spreadsheet; separator and decimal sign are found where they are not given.

    :raises InputRefused: not a table, or rows of different lengths.
    """
    if content.startswith(SPREADSHEET):
        cells, separator, decimal = _spreadsheet(content, source), "", "."
    else:
        text = _text(content, source)
        separator = separator or _separator(text)
        cells = list(csv.reader(io.StringIO(text), delimiter=separator))
    rows = [tuple(cell.strip() for cell in row) for row in cells if any(cell.strip() for cell in row)]
    if len(rows) < 2:
        raise InputRefused(f"{source}: no rows of numbers were found.")
    names = rows[0] if header else tuple(str(i + 1) for i in range(len(rows[0])))
    body = rows[1:] if header else rows
    for k, row in enumerate(body):
        if len(row) != len(names):
            raise InputRefused(
                f"{source}: row {k + 1 + header} has {len(row)} fields where the first has {len(names)}; "
                "the file is truncated or the separator is wrong."
            )
    decimal = decimal or _decimal(body, separator)
    if decimal == ",":
        body = [tuple(cell.replace(",", ".") for cell in row) for row in body]
    return ForeignTable(source, tuple(names), tuple(body), separator, decimal)


def _text(content: bytes, source: str) -> str:
    if b"\0" in content:
        raise InputRefused(f"{source} is neither a text file nor an .xlsx file.")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")  # what spreadsheets wrote before UTF-8


def _separator(text: str) -> str:
    """The sign that most lines have equally often."""
    lines = [line for line in text.splitlines() if line.strip()][:50]
    counts = {sign: Counter(line.count(sign) for line in lines).most_common(1)[0] for sign in SEPARATORS}
    likely = [sign for sign, (often, lines_so) in counts.items() if often and lines_so > 0.8 * len(lines)]
    return likely[0] if likely else ","


def _decimal(rows: list[tuple[str, ...]], separator: str) -> str:
    some = [cell for row in rows[:50] for cell in row]
    commas = sum("," in cell for cell in some)
    return "," if separator != "," and commas > sum("." in cell for cell in some) else "."


def _spreadsheet(content: bytes, source: str) -> list[list[str]]:
    """The first sheet."""
    from openpyxl import load_workbook  # here, because few files need it
    from openpyxl.utils.exceptions import InvalidFileException

    try:
        book = load_workbook(io.BytesIO(content), read_only=True, data_only=True)
        sheet = book.worksheets[0]
        return [["" if v is None else str(v) for v in row] for row in sheet.iter_rows(values_only=True)]
    except (InvalidFileException, KeyError, ValueError, IndexError, OSError) as error:
        raise InputRefused(f"{source} is not a spreadsheet that can be read: {error}.") from error
