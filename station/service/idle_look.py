"""A query of the devices on the worker's thread while no run is active."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Generic, TypeVar

from station.five_bar import Robot
from station.motion import Devices

T = TypeVar("T")
Looker = Callable[[Devices, Robot], T]


class IdleLook(Generic[T]):
    """A query that waits in the worker's queue like a run; the caller waits for its answer."""

    def __init__(self, look: Looker[T]) -> None:
        self._look = look
        self._answer: Future[T] = Future()

    def carry_out(self, devices: Devices, robot: Robot) -> None:
        """Called by the worker, once; an error becomes the answer."""
        try:
            self._answer.set_result(self._look(devices, robot))
        except Exception as error:  # noqa: BLE001 - raised again where the answer is waited for
            self._answer.set_exception(error)

    def answer(self, limit_s: float) -> T:
        """The answer of the query, or its error.  :raises TimeoutError: not within the limit"""
        return self._answer.result(limit_s)
