"""Exercises at the training desk: the error of the emulated machine, and the station's finding."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from station.records.record import Record
from station.records.result import Outcome, Verdict
from station.records.run import State

ChallengeGroup = Literal["catalogue", "unnamed", "fault"]
"""An effect in the diagnosis's catalogue, one outside it, or a fault of a device or a line."""
Score = Literal["found", "partly", "noticed", "wrong", "missed", "withstood"]
"""See `Exercise.score`."""


class Challenge(Record):
    """A possible error of the emulated machine."""

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
    """One machine with an error."""

    n: int
    unseen: bool = Field(description="drawn by the station")
    revealed: bool
    challenge: Challenge | None = Field(description="null while it is not revealed")
    joint: int | None
    size: float | None
    repaired: bool
    said: Said | None = Field(description="null until a run of this exercise has ended")
    score: Score | None
    """`found`: named, alone or with causes that cannot be distinguished from it; an unnamed error is found if
    the residual is not accounted for and no cause is confirmed; a fault, if the run failed and names the
    device. `partly`: another cause is named as well, or it is only a possible explanation. `noticed`: no
    pass, without the cause. `wrong`: another cause is named. `missed`: passed as good. `withstood`: a fault
    that did not prevent the run.
    """


class TrainingView(Record):
    """The current state of the desk."""

    challenges: tuple[Challenge, ...]
    current: Exercise | None
    done: tuple[Exercise, ...] = Field(description="of this session of the service, the newest first")
