"""Files that are named by a person."""

from __future__ import annotations

from pathlib import Path

from station.errors import InputRefused


def content_of(path: Path, what: str = "") -> bytes:
    """The content of a file.

    :param what: description of the file, as the beginning of a sentence
    :raises InputRefused: it cannot be read
    """
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputRefused(f"{what} {path} cannot be read: {error.strerror}.".lstrip()) from error
