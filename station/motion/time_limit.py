"""Calls with a time limit: stopping, making safe, closing."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping
from threading import Thread

from drivers.errors import DeviceError

log = logging.getLogger(__name__)


def each_within(limit_s: float, calls: Mapping[str, Callable[[], object]]) -> dict[str, str | None]:
    """Make all calls at once, each in its own thread, and wait no longer than the limit.

    A device that hangs then cannot prevent another one from being stopped. Returns, by name, None for a
    successful call and otherwise a sentence.
    """
    outcome: dict[str, str | None] = dict.fromkeys(calls, f"no answer within {limit_s:g} s")

    def attempt(name: str, call: Callable[[], object]) -> None:
        try:
            call()
        except DeviceError as error:
            outcome[name] = str(error)
        except Exception as error:  # boundary of a thread: the error would be lost otherwise
            log.exception("%s", name)
            outcome[name] = f"unexpected {type(error).__name__}: {error}"
        else:
            outcome[name] = None

    threads = [
        Thread(target=attempt, args=item, name=f"bounded {item[0]}", daemon=True) for item in calls.items()
    ]
    for thread in threads:
        thread.start()
    deadline = time.monotonic() + limit_s
    for thread in threads:
        thread.join(max(0.0, deadline - time.monotonic()))
    return dict(outcome)
