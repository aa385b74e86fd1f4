"""A log made elsewhere as it was given, with all that is needed to read it again."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Literal

Measured = Literal["position", "range"]
LogPart = Literal["file", "fresh"]


@dataclass(frozen=True, slots=True)
class KeptLog:
    """One file."""

    part: LogPart
    """What is learned from, or what judges it."""
    name: str
    content: bytes
    columns: str = ""
    """Its column map, JSON; empty for none."""
    measured: Measured = "position"
    """Which columns count where it has both."""

    @property
    def sha256(self) -> str:
        return hashlib.sha256(self.content).hexdigest()


@dataclass(frozen=True, slots=True)
class LogDocuments:
    """What was found in a log; finding it again may take half a minute."""

    residuals: str
    """JSON: `effects` and one row of `items` for each reading."""
    report: str
    """HTML page."""


@dataclass(frozen=True, slots=True)
class ImportedLog:
    """What is kept of a run that is made from a log."""

    files: tuple[KeptLog, ...]
    documents: LogDocuments
    readings: int
    """In all files."""
