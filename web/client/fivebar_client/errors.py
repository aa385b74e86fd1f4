"""Errors of the communication with the station."""

from __future__ import annotations

from fivebar_client.models import Problem


class StationError(Exception):
    """Every error of this client."""


class Unreachable(StationError):
    """No answer of the station within the patience of the client."""


class Unexpected(StationError):
    """An answer that this client cannot read; check that it is a station of this major version."""


class Refused(StationError):
    """The station refused, with the reason."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.detail)
        self.problem = problem
