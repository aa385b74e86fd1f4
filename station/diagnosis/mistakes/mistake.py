"""A data-entry mistake: the contract's `mistake`, with its consequences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from station.errors import InputRefused
from station.records import Index, Measurements, MistakeRecord, Phrase, phrase

Kind = Literal[
    "scale_sign", "scale_unit", "scale_factor", "angle_unit", "joint_sign", "joints_exchanged", "row_shift",
    "zero_at", "ratio", "robot_file", "mechanism", "readout_zeroed", "readout_stuck", "pasted_block",
    "position_labels", "approach_sign", "approach_missing", "commanded_angles", "coarse_angles", "time",
    "same_readings", "rehomed", "zeros_written", "glitches",
]  # fmt: skip
Severity = Literal["refused", "label", "as_effect"]
"""Refused: readings, angles or the robot file are wrong. Label: the diagnosis continues without that column
or those readings, and confirms nothing. As effect: an entry or a defect of the same size, which the diagnosis
reports as the effect with both remedies; not a `mistake` of the document.
"""
FEW = 3
"""Number of ids that are written out at each end of a longer list."""


@dataclass(frozen=True)
class Mistake:
    """One mistake and everything that is reported about it."""

    kind: Kind
    said: Phrase
    """One sentence or two: what is wrong, where, and what to do."""
    rows: tuple[int | str, ...]
    """Ids of the readings at fault; empty where the robot file or a whole file is at fault."""
    severity: Severity
    file: Literal["readings", "fresh", "both", "robot"] = "readings"
    """The file to correct."""

    @property
    def text(self) -> str:
        """In English."""
        return self.said.text()

    def record(self) -> MistakeRecord:
        """The contract's object."""
        return MistakeRecord(kind=self.kind, text=self.text, said=self.said, rows=self.rows)


class MistakeRefused(InputRefused):
    """The files cannot be diagnosed before a mistake in them is corrected."""

    def __init__(self, mistake: Mistake) -> None:
        super().__init__(mistake.text)
        self.mistake = mistake


@dataclass(frozen=True)
class Context:
    """Facts about the file beside the numbers."""

    approach_recorded: bool = True
    """Whether the file had approach columns with something in them."""
    position_recorded: bool = True
    """Whether it had position labels; otherwise each reading is its own position."""
    name: str = "the file"

    @classmethod
    def of(cls, measurements: Measurements) -> Context:
        """As far as the numbers still show it."""
        recorded = bool(measurements.approach.any()) and "approach" not in measurements.guessed
        labelled = len(np.unique(measurements.position)) < len(measurements)
        return cls(recorded, labelled and "position" not in measurements.guessed)


def ids(measurements: Measurements, rows: Index | Sequence[int]) -> tuple[int | str, ...]:
    """Ids of rows by index."""
    return tuple(measurements.ids[int(k)] for k in rows)


def named(rows: Sequence[int | str]) -> Phrase:
    """Ids in words: "reading 7", "readings 61 to 120", "readings 3, 9 and 12"."""
    if len(rows) == 1:
        return phrase("reading", id=rows[0])
    whole = [r for r in rows if isinstance(r, int)]
    if len(whole) == len(rows) and whole == list(range(whole[0], whole[0] + len(whole))) and len(rows) > 2:
        return phrase("readings_from_to", first=rows[0], last=rows[-1])
    if len(rows) > 3 * FEW:
        shown = ", ".join(str(r) for r in rows[: 2 * FEW])
        return phrase("readings_many", count=len(rows), shown=shown, last=rows[-1])
    shown = ", ".join(str(r) for r in rows[:-1])
    return phrase("readings_and", shown=shown, last=rows[-1])


def rows_named(by: int) -> Phrase:
    """A number of rows, singular or plural."""
    return phrase("row") if abs(by) == 1 else phrase("rows", count=abs(by))


def angle_columns(joints: Sequence[int]) -> tuple[str, ...]:
    """The names of the angle columns in the file."""
    return tuple(f"theta{i + 1}_deg" for i in joints)


def joints_named(joints: Sequence[int]) -> tuple[Phrase, ...]:
    """Joints by index from 0, in words."""
    return tuple(phrase("joint", number=i + 1) for i in joints)
