"""A call that may hang, on a thread that nothing else waits for."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TypeVar

from anyio import CapacityLimiter, fail_after, to_thread
from pydantic import JsonValue

from station.records import Actor
from station.service import Orchestrator

T = TypeVar("T")
RECORD_WAIT_S = 0.5
_UNLIMITED = CapacityLimiter(math.inf)
"""Calls that hang must not use up the threads of the others."""


async def record_later(
    orchestrator: Orchestrator,
    by: Actor,
    action: str,
    subject: str,
    after: Mapping[str, JsonValue] | None = None,
) -> None:
    """An entry of the audit about what was done already, made after it was answered.

    A database that is locked does not hold the caller's connection: the entry follows when it can.
    """
    written = orchestrator.late_records.deed(by, action, subject, after)
    await aside(lambda: written.wait(RECORD_WAIT_S))


async def aside(function: Callable[[], T], *, timeout_s: float | None = None) -> T:
    """What `function` returns or raises.

    :raises TimeoutError: it has not come back; its thread is left to itself.
    """
    with fail_after(timeout_s):
        return await to_thread.run_sync(function, abandon_on_cancel=True, limiter=_UNLIMITED)
