"""One request, repeated while the station is unreachable or busy, and its parsed answer."""

from __future__ import annotations

import random
import time
from typing import TypeVar

import httpx2 as httpx
from pydantic import BaseModel, ValidationError

from fivebar_client.errors import Refused, Unexpected, Unreachable
from fivebar_client.models import Problem

Answer = TypeVar("Answer", bound=BaseModel)
LONGEST_WAIT_S = 5.0
_OF_PROXIES = (502, 503, 504)
"""Statuses of a proxy whose station is unreachable."""


class Asking:
    """Repeats requests that may be repeated: reads, and commands without a second effect."""

    def __init__(self, http: httpx.Client, patience_s: float) -> None:
        """:param patience_s: time limit for repeating a request while the station is unreachable or busy"""
        self._http, self._patience_s = http, patience_s

    def once(self, method: str, path: str, **request: object) -> httpx.Response:
        """The answer, whatever its status. :raises Unreachable: there is none."""
        try:
            return self._http.request(method, path, **request)  # type: ignore[arg-type]
        except httpx.TransportError as error:
            raise Unreachable(f"{method} {path}: {error or type(error).__name__}") from error

    def ask(self, method: str, path: str, **request: object) -> httpx.Response:
        """The answer, with a status below 400.

        :raises Refused: the station refused, or was busy all the time.
        :raises Unreachable: there was no answer.
        """
        deadline_s = time.monotonic() + self._patience_s
        wait_s = 0.1
        while True:
            try:
                answer = self.once(method, path, **request)
                if time.monotonic() >= deadline_s or not _again(answer):
                    return accepted(answer)
                wished_s = _retry_after_s(answer)
            except Unreachable:
                if time.monotonic() >= deadline_s:
                    raise
                wished_s = None
            some_s = wait_s * random.uniform(0.5, 1.0)  # noqa: S311 - not all clients at once
            pause_s = some_s if wished_s is None else wished_s
            time.sleep(max(0.0, min(deadline_s - time.monotonic(), pause_s)))
            wait_s = min(2 * wait_s, LONGEST_WAIT_S)

    def read(self, kind: type[Answer], method: str, path: str, **request: object) -> Answer:
        """The answer's document.  :raises: as `ask`, and `Unexpected`."""
        return read(kind, self.ask(method, path, **request))


def read(kind: type[Answer], answer: httpx.Response) -> Answer:
    """:raises Unexpected: it is not of this kind."""
    try:
        return kind.model_validate_json(answer.content)
    except ValidationError as error:
        raise Unexpected(f"{answer.request.url} does not answer a {kind.__name__}: {error}") from error


def _again(answer: httpx.Response) -> bool:
    return answer.status_code in _OF_PROXIES or (answer.is_error and "retry-after" in answer.headers)


def accepted(answer: httpx.Response) -> httpx.Response:
    """The same.  :raises Refused: it is a problem document.
    :raises Unreachable: it comes from a proxy whose station is unreachable.
    """
    if not answer.is_error:
        return answer
    try:
        problem = Problem.model_validate_json(answer.content)
    except ValidationError as error:
        kind = Unreachable if answer.status_code in _OF_PROXIES else Unexpected
        text = f"{answer.request.url} answered {answer.status_code} {answer.reason_phrase}."
        raise kind(text) from error
    raise Refused(problem)


def _retry_after_s(answer: httpx.Response | None) -> float | None:
    said = answer.headers.get("retry-after", "") if answer is not None else ""
    return float(said) if said.isdecimal() else None
