"""Waiting for another thread or process."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

PATIENCE_S = 10.0
_LOOK_S = 0.005

Found = TypeVar("Found")


def soon(look: Callable[[], Found | None], why: str = "", *, within_s: float = PATIENCE_S) -> Found:
    """The result of `look` as soon as it is true.  :raises AssertionError: it has not become so in time."""
    deadline_s = time.monotonic() + within_s
    while not (found := look()):
        assert time.monotonic() < deadline_s, why or found
        time.sleep(_LOOK_S)
    return found


@contextmanager
def all_threads_end() -> Iterator[None]:
    """All threads started inside end soon after it."""
    before = set(threading.enumerate())
    yield
    for thread in set(threading.enumerate()) - before:
        thread.join(5)
        assert not thread.is_alive(), thread.name
