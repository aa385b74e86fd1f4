"""A call that may hang, on a thread that nothing else waits for."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from anyio import CapacityLimiter, fail_after, to_thread

T = TypeVar("T")
_UNLIMITED = CapacityLimiter(math.inf)
"""Calls that hang must not use up the threads of the others."""


async def aside(function: Callable[[], T], *, timeout_s: float | None = None) -> T:
    """What `function` returns or raises.

    :raises TimeoutError: it has not come back; its thread is left to itself.
    """
    with fail_after(timeout_s):
        return await to_thread.run_sync(function, abandon_on_cancel=True, limiter=_UNLIMITED)
