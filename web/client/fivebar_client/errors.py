"""What can go wrong between a program and the station."""

from __future__ import annotations

from fivebar_client.models import Problem


class StationError(Exception):
    """Every error of this client."""


class Unreachable(StationError):
    """No answer of the station within the patience of the client."""


class Unexpected(StationError):
    """An answer that this client cannot read: is it a station, and of this major version?"""


class Refused(StationError):
    """The station says no, and why."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.detail)
        self.problem = problem
