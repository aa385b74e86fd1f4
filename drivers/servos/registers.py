"""Signed 32-bit values in pairs of registers, high word first, as in both drive families."""

from __future__ import annotations

from collections.abc import Sequence


def words_of(*values: int) -> list[int]:
    """Each value as two registers."""
    return [word for value in values for word in ((value >> 16) & 0xFFFF, value & 0xFFFF)]


def values_of(words: Sequence[int]) -> list[int]:
    """Each two registers as a value.  :raises ValueError: an odd number of them"""
    unsigned = [high << 16 | low for high, low in zip(words[::2], words[1::2], strict=True)]
    return [value - (1 << 32) if value & (1 << 31) else value for value in unsigned]
