"""Serials and names given by people: printable, distinguishable, and usable in an address."""

from __future__ import annotations

import unicodedata

from station.errors import InputRefused

LONGEST = 64
_BETWEEN = ".-_/"
_INVISIBLE = ("Cc", "Cs", "Zl", "Zp")
"""Categories of control characters, halves of UTF-16 pairs, line and paragraph separators."""
_ALIKE = frozenset({"Latin", "Cyrillic", "Greek", "Armenian"})
"""Scripts with letters that look the same; names in other scripts often contain Latin letters."""


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


def checked_account(text: str) -> str:
    """The name of a user or a key, in the form in which two names that look the same are the same.

    :raises InputRefused: it is too long then, has invisible characters, or looks like another one.
    """
    name = _plain(text)
    if not name or len(name) > LONGEST:
        raise InputRefused(f"Name {shown(text)} has {len(name)} characters; use 1 to {LONGEST}.")
    for c in name:
        if unicodedata.category(c) in (*_INVISIBLE, "Cf"):
            raise InputRefused(f"Name {shown(text)} holds the invisible character {shown(c)}; leave it out.")
    scripts = sorted({_script(c) for c in name if c.isalpha()} & _ALIKE)
    if len(scripts) > 1:
        raise InputRefused(f"Name {shown(text)} mixes letters of {' and '.join(scripts)}; use one script.")
    return name


def account_key(name: str) -> str:
    """Equal for names that are the same account: in any case, composed or not, of any width."""
    return _plain(_plain(name).casefold())


def one_line(text: str) -> str:
    """The text with its control and invisible characters as escapes."""
    return "".join(ascii(c)[1:-1] if unicodedata.category(c) in (*_INVISIBLE, "Cf") else c for c in text)


def _plain(text: str) -> str:
    return " ".join(unicodedata.normalize("NFKC", text).split())


def shown(text: str) -> str:
    """In quotation marks, with invisible characters as escapes."""
    return ascii(text) if not text.isprintable() else repr(text)


def _script(letter: str) -> str:
    return unicodedata.name(letter, "unnamed").partition(" ")[0].capitalize()
