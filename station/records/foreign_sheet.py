"""Spreadsheets as rows of cells."""

from __future__ import annotations

import io
import logging
import zlib
from collections.abc import Iterable
from datetime import datetime
from zipfile import BadZipFile

from station.errors import InputRefused
from station.records.foreign_numbers import is_number

log = logging.getLogger(__name__)

SPREADSHEET = b"PK\x03\x04"
"""An .xlsx file is a zip archive."""
OLD_SPREADSHEET = b"\xd0\xcf\x11\xe0"
"""An .xls file, or an .xlsx file with a password."""


def read_spreadsheet(content: bytes, source: str, wanted: str = "") -> list[list[str]]:
    """The rows of one sheet: the requested one, otherwise the one with most numbers.

    :raises InputRefused: the file is not a spreadsheet, or has no such sheet.
    """
    from openpyxl import load_workbook  # imported here, because few files need it
    from openpyxl.utils.exceptions import InvalidFileException

    unreadable = (InvalidFileException, BadZipFile, KeyError, ValueError, TypeError, IndexError, EOFError)
    try:
        book = load_workbook(io.BytesIO(content), read_only=True, data_only=True)
        names = [sheet.title for sheet in book.worksheets]
        if wanted and wanted not in names:
            raise InputRefused(f"{source} has no sheet {wanted!r}; it has {', '.join(names)}.")
        sheets = {
            sheet.title: [[_text(v) for v in row] for row in sheet.iter_rows(values_only=True)]
            for sheet in book.worksheets
            if not wanted or sheet.title == wanted
        }
    except (*unreadable, OSError, SyntaxError, zlib.error) as error:
        raise InputRefused(f"{source} is not a spreadsheet that can be read: {error}.") from error
    if not sheets:
        raise InputRefused(f"{source} has no sheet with cells.")
    chosen = max(sheets, key=lambda name: _numbers(sheets[name]))
    if len(names) > 1 and not wanted:
        log.warning("%s: sheet %r is read, of %s.", source, chosen, ", ".join(names))
    return sheets[chosen]


def _text(value: object) -> str:
    if value is None:
        return ""
    return value.isoformat() if isinstance(value, datetime) else str(value)


def _numbers(rows: Iterable[Iterable[str]]) -> int:
    return sum(is_number(cell) for row in rows for cell in row)
