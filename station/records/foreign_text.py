"""Text files as rows of cells: encodings, comments, and the separator."""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections import Counter

from station.errors import InputRefused
from station.records.foreign_numbers import is_number

SEPARATORS = (";", "\t", "|", ",")
BLANKS = " "
"""Any number of blanks, as in the tables of numerical software."""
COMMENTS = ("#", "%", "//")
_LOOKED_AT = 200
_PAIRS = re.compile(rb"(?:[\x00-\x7f]|[\xa1-\xf7][\xa1-\xfe])*")
_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def read_text(content: bytes, source: str, separator: str = "") -> tuple[list[tuple[int, list[str]]], str]:
    """Rows with the numbers of their last lines, and the separator, detected if not given.

    :raises InputRefused: the file is not a text file.
    """
    text = _decoded(content, source)
    try:
        separator = separator or _separator(text)
        return _split(text, separator), separator
    except (csv.Error, TypeError) as error:
        raise InputRefused(
            f"{source} is not a table: {error}; check its quotes and the separator."
        ) from error


def _decoded(content: bytes, source: str) -> str:
    if content.startswith(_UTF_16):
        return content.decode("utf-16", errors="replace")
    if b"\0" in content:
        raise InputRefused(
            f"{source} is neither a text file nor an .xlsx file; save the table as .csv or .xlsx."
        )
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        # encodings of spreadsheets before UTF-8: in China pairs of high bytes, in the West single ones
        return content.decode("gb18030" if _PAIRS.fullmatch(content) else "cp1252", errors="replace")


def _split(text: str, separator: str) -> list[tuple[int, list[str]]]:
    """Rows numbered from 1; empty lines are omitted, and the sign of a comment."""
    lines = text.splitlines()
    if separator == BLANKS:
        rows = [(k + 1, _uncommented(line).split()) for k, line in enumerate(lines)]
    else:
        reader = csv.reader(io.StringIO("\n".join(map(_uncommented, lines))), delimiter=separator)
        rows = [(reader.line_num, row) for row in reader]
    stripped = [(line, [cell.strip() for cell in row]) for line, row in rows]
    return [(line, row) for line, row in stripped if any(row)]


def _uncommented(line: str) -> str:
    start = line.lstrip()
    sign = next((sign for sign in COMMENTS if start.startswith(sign)), "")
    return start[len(sign) :].lstrip() if sign else line


def _separator(text: str) -> str:
    """The separator that gives most numbers in the rows of the most frequent length."""
    some = "\n".join(text.splitlines()[:_LOOKED_AT])

    def score(sign: str) -> tuple[float, int]:
        rows = [row for _, row in _split(some, sign)]
        if not rows:
            return 0.0, 0
        length, often = Counter(len(row) for row in rows).most_common(1)[0]
        cells = [cell for row in rows if len(row) == length for cell in row if cell]
        if length < 2 or not cells:
            return 0.0, 0
        return round(often / len(rows) * sum(map(is_number, cells)) / len(cells), 1), length

    return max((*SEPARATORS, BLANKS), key=score)
