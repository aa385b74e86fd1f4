"""Asking again, for a limited time."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from drivers.errors import GarbledReply, LinkLost

_FIRST_PAUSE_S, _LONGEST_PAUSE_S = 0.01, 0.2

T = TypeVar("T")


def within(budget_s: float, ask: Callable[[], T]) -> T:
    """What `ask` returns; it is asked again, ever less often, while its reply is late or malformed.

    Every request passes here, some dozens for each reading, and nearly all are answered at once.

    :param budget_s: no attempt begins later than this after the first
    :raises DeviceError: of the first attempt: what failed then is the cause, what followed may be its effect
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
