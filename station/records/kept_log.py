"""An imported log as received, with everything needed to read it again."""

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
    """`file`: the model is learned from it; `fresh`: it confirms the model."""
    name: str
    content: bytes
    columns: str = ""
    """Its column map, JSON; empty if there is none."""
    measured: Measured = "position"
    """Which measurement to use if the log contains both."""

    @property
    def sha256(self) -> str:
        return hashlib.sha256(self.content).hexdigest()


@dataclass(frozen=True, slots=True)
class LogDocuments:
    """The results from a log; computing them again may take half a minute."""

    residuals: str
    """JSON: `effects` and one row of `items` for each reading."""
    report: str
    """HTML page."""


@dataclass(frozen=True, slots=True)
class ImportedLog:
    """The stored data of a run that is made from a log."""

    files: tuple[KeptLog, ...]
    documents: LogDocuments
    readings: int
    """Number of readings in all files."""
