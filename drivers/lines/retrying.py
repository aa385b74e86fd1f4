"""Repeated requests with a time limit."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from drivers.errors import GarbledReply, LinkLost

_FIRST_PAUSE_S, _LONGEST_PAUSE_S = 0.01, 0.2

T = TypeVar("T")


def within(budget_s: float, ask: Callable[[], T]) -> T:
    """The result of `ask`; it is called again, at increasing intervals, while its reply is late or malformed.

    Every request uses this function, dozens for each reading, and nearly all are answered at once.

    :param budget_s: no attempt begins later than this after the first
    :raises DeviceError: that of the first attempt: it is the cause, and later errors may be its consequences
    """
    until_s = time.monotonic() + budget_s
    pause_s = _FIRST_PAUSE_S
    cause: GarbledReply | LinkLost | None = None
    while True:
        try:
            return ask()
        except (GarbledReply, LinkLost) as error:
            cause = cause or error
            if time.monotonic() + pause_s >= until_s:
                raise cause from None
        time.sleep(pause_s)
        pause_s = min(2 * pause_s, _LONGEST_PAUSE_S)
