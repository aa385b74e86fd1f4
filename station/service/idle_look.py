"""A look at the devices by the thread that works with them, while nothing runs."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Generic, TypeVar

from station.five_bar import Robot
from station.motion import Devices

T = TypeVar("T")
Looker = Callable[[Devices, Robot], T]


class IdleLook(Generic[T]):
    """Waits in the worker's queue like a run; whoever asked waits for its answer."""

    def __init__(self, look: Looker[T]) -> None:
        self._look = look
        self._answer: Future[T] = Future()

    def carry_out(self, devices: Devices, robot: Robot) -> None:
        """Called by the worker, once; whatever fails is the answer."""
        try:
            self._answer.set_result(self._look(devices, robot))
        except Exception as error:  # noqa: BLE001 - raised again where the answer is waited for
            self._answer.set_exception(error)

    def answer(self, limit_s: float) -> T:
        """What the look answered or raised.  :raises TimeoutError: not within the limit"""
        return self._answer.result(limit_s)
