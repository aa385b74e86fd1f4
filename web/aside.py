"""A call that may hang, on a thread of its own: it can neither hold up the event loop nor use up its pool."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import TypeVar

T = TypeVar("T")


async def aside(function: Callable[[], T], *, timeout_s: float | None = None) -> T:
    """What `function` returns or raises.

    :raises TimeoutError: it has not come back; its thread is left to itself.
    """
    future: Future[T] = Future()

    def work() -> None:
        future.set_running_or_notify_cancel()
        try:
            future.set_result(function())
        except Exception as error:  # noqa: BLE001 - handed to whoever awaits
            future.set_exception(error)

    Thread(target=work, name="aside", daemon=True).start()
    return await asyncio.wait_for(asyncio.wrap_future(future), timeout_s)
