"""The common base of all readouts on their own line: name, lock, life cycle, repeated requests."""

from __future__ import annotations

import logging
from abc import ABC, abstractmethod
from collections.abc import Callable
from threading import RLock
from typing import TypeVar

from drivers.errors import GarbledReply, LinkLost
from drivers.lines import OnLine, SerialLine, within

log = logging.getLogger(__name__)

_BUDGET_S = 0.5

_T = TypeVar("_T")


class Readout(OnLine, ABC):
    """Base of a `LinearScale`; may be called from any thread."""

    def __init__(self, line: SerialLine, *, name: str, timeout_s: float, budget_s: float | None) -> None:
        """:param budget_s: time limit for repeated requests; by default three time-outs and half a second"""
        super().__init__(line)
        self._name = name
        self._timeout_s = timeout_s
        self._budget_s = 3 * timeout_s + _BUDGET_S if budget_s is None else budget_s
        self._lock = RLock()
        if line.notice:
            log.warning("%s", line.notice)

    @property
    def name(self) -> str:
        return self._name

    def make_safe(self) -> None:
        """A readout moves nothing."""

    def close(self) -> None:
        with self._lock:
            self._line.close()

    @abstractmethod
    def _prepare(self) -> None:
        """Called before a request: no older reply may answer it."""

    @abstractmethod
    def _has_failed(self) -> None:
        """A reply was late or malformed."""

    def _retried(self, ask: Callable[[], _T]) -> _T:
        """Call `ask` again when its reply is late or malformed: reading twice changes nothing."""

        def attempt() -> _T:
            try:
                self._prepare()
                return ask()
            except (GarbledReply, LinkLost):
                self._has_failed()
                self._line.renew()
                raise

        return within(self._budget_s, attempt)
