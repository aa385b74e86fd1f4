"""A call that may hang, on a separate thread."""

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
    """Record a completed action in the audit after its answer was sent.

    A locked database does not hold the caller's connection: the entry follows later.
    """
    written = orchestrator.late_records.deed(by, action, subject, after)
    await aside(lambda: written.wait(RECORD_WAIT_S))


async def aside(function: Callable[[], T], *, timeout_s: float | None = None) -> T:
    """The result or the error of `function`.

    :raises TimeoutError: it has not returned; its thread continues alone.
    """
    with fail_after(timeout_s):
        return await to_thread.run_sync(function, abandon_on_cancel=True, limiter=_UNLIMITED)
