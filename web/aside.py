"""A call that may hang, on a thread that nothing else waits for."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import TypeVar

from anyio import CapacityLimiter, fail_after, to_thread
from pydantic import JsonValue

from station.errors import StoreUnavailable
from station.records import Actor
from station.store import Store

log = logging.getLogger(__name__)

T = TypeVar("T")
RECORD_WAIT_S = 0.5
_UNLIMITED = CapacityLimiter(math.inf)
"""Calls that hang must not use up the threads of the others."""


async def record_later(
    store: Store, by: Actor, action: str, subject: str, after: Mapping[str, JsonValue] | None = None
) -> None:
    """An entry of the audit about what was done already, made after it was answered.

    A database that is locked does not hold the caller's connection: the entry follows when it can.
    """

    def record() -> None:
        try:
            store.record(by, action, subject, after=after)
        except StoreUnavailable:
            log.exception("%s by %s could not be recorded in the audit", action, by.name)

    with suppress(TimeoutError):
        await aside(record, timeout_s=RECORD_WAIT_S)


async def aside(function: Callable[[], T], *, timeout_s: float | None = None) -> T:
    """What `function` returns or raises.

    :raises TimeoutError: it has not come back; its thread is left to itself.
    """
    with fail_after(timeout_s):
        return await to_thread.run_sync(function, abandon_on_cancel=True, limiter=_UNLIMITED)
