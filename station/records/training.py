"""Exercises at the training desk: what was wrong with the emulated machine, and what the station said."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from station.records.record import Record
from station.records.result import Outcome, Verdict
from station.records.run import State

ChallengeGroup = Literal["catalogue", "unnamed", "fault"]
"""An effect that the diagnosis knows, one that it does not know, a fault of a device or a line."""
Score = Literal["found", "partly", "noticed", "wrong", "missed", "withstood"]
"""See `Exercise.score`."""


class Challenge(Record):
    """Something that can be wrong with the emulated machine."""

    kind: str
    group: ChallengeGroup
    joint: bool = Field(description="whether it is at one of the joints")
    unit: str = Field(description="of its size; empty where it has none")
    smallest: float | None
    usual: float | None
    largest: float | None


class Blamed(Record):
    """A cause that the station named."""

    effect: str
    joint: int | None
    part: str | None
    probability: float | None


class Said(Record):
    """How the run of an exercise ended."""

    run: int
    state: State
    verdict: Verdict | None
    outcome: Outcome | None
    reason: str | None
    diagnosis: str | None = Field(description="verdict of the diagnosis; null where there is none")
    confirmed: bool | None
    causes: tuple[Blamed, ...]


class Exercise(Record):
    """One machine that something is wrong with."""

    n: int
    unseen: bool = Field(description="drawn by the station")
    revealed: bool
    challenge: Challenge | None = Field(description="null while it is not revealed")
    joint: int | None
    size: float | None
    repaired: bool
    said: Said | None = Field(description="null until a run of this exercise has ended")
    score: Score | None
    """`found`: named, alone or with what cannot be distinguished from it; an error without a name is found
    when the residual is not accounted for and no cause is confirmed; a fault, when the run failed and names
    the device.  `partly`: something else is named beside it, or it is a possible explanation only.
    `noticed`: no pass, without the cause.  `wrong`: another cause is named.  `missed`: passed as good.
    `withstood`: a fault that the run got over."""


class TrainingView(Record):
    """The desk at this moment."""

    challenges: tuple[Challenge, ...]
    current: Exercise | None
    done: tuple[Exercise, ...] = Field(description="of this session of the service, the newest first")
