"""Asking again, for a limited time."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from tenacity import Retrying, retry_if_exception_type, stop_before_delay, wait_exponential

from drivers.errors import GarbledReply, LinkLost

_FIRST_PAUSE_S, _LONGEST_PAUSE_S = 0.01, 0.2

T = TypeVar("T")


def within(budget_s: float, ask: Callable[[], T]) -> T:
    """What `ask` returns; it is asked again, ever less often, while its reply is late or malformed.

    :param budget_s: no attempt begins later than this after the first
    :raises DeviceError: of the first attempt: what failed then is the cause, what followed may be its effect
    """
    causes: list[Exception] = []

    def attempt() -> T:
        try:
            return ask()
        except (GarbledReply, LinkLost) as error:
            causes.append(error)
            raise

    attempts = Retrying(
        stop=stop_before_delay(budget_s),
        wait=wait_exponential(multiplier=_FIRST_PAUSE_S, max=_LONGEST_PAUSE_S),
        retry=retry_if_exception_type((GarbledReply, LinkLost)),
        reraise=True,
    )
    try:
        return attempts(attempt)
    except (GarbledReply, LinkLost):
        raise causes[0] from None
