"""Numbers as other software writes them: decimal comma, thousands separators, signs for "no value"."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

NO_VALUE = frozenset(
    {"", "-", "--", "nan", "n/a", "na", "null", "none", "inf", "-inf", "#n/a", "#num!", "#value!"}
)
"""Content of a cell without a measured value, in lower case."""
_BLANKS = "\u00a0\u2007\u2009\u202f' "
"""Characters that only group digits."""
_NUMBER = re.compile(rf"[+-]?(\d[\d{_BLANKS}]*([.,]\d+)*[.,]?|[.,]\d+)(e[+-]?\d+)?", re.IGNORECASE)
_GROUPED = {sign: re.compile(rf"[+-]?\d{{1,3}}({re.escape(sign)}\d{{3}})+") for sign in ".,"}


@dataclass(frozen=True)
class NumberSigns:
    """The number format of one file."""

    decimal: str
    """`.` or `,`"""
    thousands: str = ""
    """The other of the two, if it groups digits."""

    def plain(self, cell: str) -> str:
        """A cell with a decimal point and without grouping; a cell that is not a number is unchanged."""
        if not is_number(cell):
            return cell
        for sign in (*_BLANKS, *self.thousands):
            cell = cell.replace(sign, "")
        return cell.replace(self.decimal, ".")


def is_number(cell: str) -> bool:
    """Whether a cell contains a number, in any format."""
    return _NUMBER.fullmatch(cell) is not None


def has_value(cell: str) -> bool:
    """Whether a cell contains a value."""
    return cell.lower() not in NO_VALUE


def signs_of(cells: Iterable[str], decimal: str = "") -> NumberSigns:
    """The number format of these cells.

    In a number with both signs the last one is the decimal sign. If no number has both, a comma is the
    decimal sign, unless every comma groups three digits and one number has several of them.

    :param decimal: the decimal sign, if known
    """
    numbers = [cell for cell in cells if is_number(cell)]
    if not decimal:
        decimal = _decimal(numbers)
    other = "," if decimal == "." else "."
    return NumberSigns(decimal, other if any(other in number for number in numbers) else "")


def _decimal(numbers: list[str]) -> str:
    both = [number for number in numbers if "." in number and "," in number]
    if both:
        commas = sum(number.rfind(",") > number.rfind(".") for number in both)
        return "," if 2 * commas > len(both) else "."
    commas_only = [number for number in numbers if "," in number]
    points_only = [number for number in numbers if "." in number]
    if _all_grouped(commas_only, ","):
        return "."
    if commas_only and (not points_only or _all_grouped(points_only, ".")):
        return ","
    return "," if len(commas_only) > len(points_only) else "."


def _all_grouped(numbers: list[str], sign: str) -> bool:
    return any(number.count(sign) > 1 for number in numbers) and all(
        _GROUPED[sign].fullmatch(number) for number in numbers
    )
