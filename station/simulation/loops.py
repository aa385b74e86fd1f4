"""An asyncio event loop over the scheduler, and its tasks as threads: the processing of requests."""

from __future__ import annotations

import asyncio
import contextvars
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any, TypeVar

from anyio import CancelScope, CapacityLimiter, to_thread

from station.simulation.scheduler import Scheduler

T = TypeVar("T")


class VirtualLoop(asyncio.BaseEventLoop):
    """The loop of one task; its time is that of the scheduler, and it waits as a task of it."""

    def __init__(self, scheduler: Scheduler) -> None:
        super().__init__()
        self._scheduler = scheduler
        self._selector = self
        self._woken = False

    def time(self) -> float:
        return self._scheduler.now_s

    def select(self, timeout: float | None) -> list[object]:
        """Replaces a selector: waits until another task has called, or the time is over."""
        if timeout is None or timeout > 0.0:
            self._scheduler.wait(lambda: self._woken, timeout)
        self._woken = False
        return []

    def _process_events(self, events: list[object]) -> None:
        """Nothing to do: no files are watched."""

    def _write_to_self(self) -> None:
        self._woken = True


class Threads:
    """Replace the threads of anyio, which run the non-`async` parts of a route."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler

    async def run_sync(
        self,
        function: Callable[..., T],
        *args: Any,
        abandon_on_cancel: bool = False,
        limiter: CapacityLimiter | None = None,
    ) -> T:
        """As `anyio.to_thread.run_sync`; there are always enough threads."""
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[T] = loop.create_future()
        context = contextvars.copy_context()

        def work() -> None:
            settle: Callable[[], None]
            try:
                settle = partial(_settle, answer.set_result, answer, context.run(function, *args))
            except Exception as error:  # noqa: BLE001 - raised where it is waited for
                settle = partial(_settle, answer.set_exception, answer, error)
            if not loop.is_closed():
                loop.call_soon_threadsafe(settle)

        self._scheduler.spawn(work, "worker of a request")
        with CancelScope(shield=not abandon_on_cancel):
            result = await answer
        return result  # noqa: RET504 - a scope may swallow, as far as mypy knows


def _settle(set_it: Callable[[Any], None], answer: asyncio.Future[Any], value: object) -> None:
    if not answer.done():
        set_it(value)


@contextmanager
def threads_of_requests(scheduler: Scheduler) -> Iterator[None]:
    """Every request to anyio for a thread gets a task of the scheduler instead, until the block ends."""
    real, to_thread.run_sync = to_thread.run_sync, Threads(scheduler).run_sync  # type: ignore[assignment]
    try:
        yield
    finally:
        to_thread.run_sync = real
