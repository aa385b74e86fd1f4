"""Numbers, dates and times in the format of a language."""

from __future__ import annotations

import math
from datetime import date, datetime

from station.messages.texts import DECIMAL_COMMA, Language

_DATE: dict[Language, str] = {"en": "%Y-%m-%d", "de": "%d.%m.%Y", "zh": "%Y-%m-%d"}
_UNITS = {"deg": "°", "deg/kg": "°/kg", "um/m": "µm/m", "um/m/K": "µm/(m K)", "um/K": "µm/K", "1/rev": ""}


def local_number(value: float, digits: int, language: Language) -> str:
    """A number with this many decimals and a real minus sign; a dash if it is not a number."""
    if not math.isfinite(value):
        return "–"
    text = f"{value:.{digits}f}"
    if float(text) == 0.0:
        text = text.removeprefix("-")
    text = text.replace("-", "\N{MINUS SIGN}")
    return number_in_words(text, language)


def number_in_words(text: str, language: Language) -> str:
    """A formatted number, with the decimal sign of the language."""
    return text.replace(".", ",") if language in DECIMAL_COMMA else text


def unit_name(unit: str) -> str:
    """A unit in its usual form."""
    return _UNITS.get(unit, unit)


def measured(value: float, u95: float | None, unit: str, language: Language) -> str:
    """Value ± U with the unit, to two digits of U; without U the value to six digits."""
    unit = unit_name(unit)
    tail = f"\N{NO-BREAK SPACE}{unit}" if unit else ""
    if u95 is None or not u95 > 0 or not math.isfinite(u95):
        digits = max(0, 5 - math.floor(math.log10(abs(value)))) if value and math.isfinite(value) else 0
        return local_number(value, min(digits, 9), language) + tail
    digits = min(max(1 - math.floor(math.log10(u95)), 0), 9)
    return f"{local_number(value, digits, language)} ± {local_number(u95, digits, language)}{tail}"


def local_date(day: date, language: Language) -> str:
    """A day."""
    return day.strftime(_DATE[language])


def local_time(moment: datetime, language: Language) -> str:
    """A time to the minute, in this computer's zone, with the difference from UTC."""
    here = moment.astimezone()
    offset = here.strftime("%z")
    return f"{here.strftime(_DATE[language])} {here.strftime('%H:%M')} UTC{offset[:3]}:{offset[3:5]}"
