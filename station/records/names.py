"""Serials and names given by people: printable, distinguishable, and usable in an address."""

from __future__ import annotations

import unicodedata

from station.errors import InputRefused

LONGEST = 64
_BETWEEN = ".-_/"
_INVISIBLE = ("Cc", "Cs", "Zl", "Zp")
"""Categories of control characters, halves of UTF-16 pairs, line and paragraph separators."""


def checked_serial(text: str) -> str:
    """The serial of a robot.

    :raises InputRefused: it could be a path, or be confused with another that looks the same.
    """
    said = f"Serial {shown(text)}"
    if not text or len(text) > LONGEST:
        raise InputRefused(f"{said} has {len(text)} characters; use 1 to {LONGEST}.")
    for c in text:
        if not (c.isalpha() or c in _BETWEEN or (c.isascii() and c.isdigit())):
            raise InputRefused(
                f"{said} holds {shown(c)}; use letters, digits 0 to 9 and {' '.join(_BETWEEN)}."
            )
    if unicodedata.normalize("NFKC", text) != text:
        raise InputRefused(f"{said} holds full-width or otherwise special letters; use plain ones.")
    scripts = sorted({_script(c) for c in text if c.isalpha()})
    if len(scripts) > 1:
        raise InputRefused(f"{said} mixes letters of {' and '.join(scripts)}; use those of one script.")
    if any(part.strip(".") == "" for part in text.split("/")):
        raise InputRefused(f"{said} has a part of nothing or of dots alone between slashes; name each part.")
    return text


def checked_name(text: str) -> str:
    """The name of a person or a work order.  :raises InputRefused: it cannot be printed in a line."""
    for c in text:
        if unicodedata.category(c) in _INVISIBLE:
            raise InputRefused(f"Name {shown(text)} holds the control character {shown(c)}; leave it out.")
    return text


def shown(text: str) -> str:
    """In quotation marks, with invisible characters as escapes."""
    return ascii(text) if not text.isprintable() else repr(text)


def _script(letter: str) -> str:
    return unicodedata.name(letter, "unnamed").partition(" ")[0].capitalize()
