"""Files that people name."""

from __future__ import annotations

from pathlib import Path

from station.errors import InputRefused


def content_of(path: Path, what: str = "") -> bytes:
    """What a file holds.

    :param what: the file is, as the beginning of a sentence
    :raises InputRefused: it cannot be read
    """
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputRefused(f"{what} {path} cannot be read: {error.strerror}.".lstrip()) from error
