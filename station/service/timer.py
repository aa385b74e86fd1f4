"""Periodic work of the station, each on its own thread."""

from __future__ import annotations

import logging
from collections.abc import Callable
from threading import Event, Thread
from typing import Self

from station.errors import InputRefused, StoreUnavailable

log = logging.getLogger(__name__)

RETRY_S = 600.0


class Timer:
    """Calls a function periodically while it is entered; after an error it is tried again sooner."""

    def __init__(self, name: str, do: Callable[[], object], every_s: float, first_s: float = 0.0) -> None:
        """:param first_s: time until the first call"""
        self._do, self._every_s, self._first_s = do, every_s, first_s
        self._closing = Event()
        self._thread = Thread(target=self._run, name=name, daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._closing.set()
        self._thread.join()

    def _run(self) -> None:
        wait_s = self._first_s
        while not self._closing.wait(wait_s):
            wait_s = self._every_s
            try:
                self._do()
            except (InputRefused, StoreUnavailable) as error:
                log.error("%s: %s", self._thread.name, error)
                wait_s = min(wait_s, RETRY_S)
