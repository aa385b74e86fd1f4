"""Replacements for imports of production code from `time`, `datetime` and `secrets`, in virtual time."""

from __future__ import annotations

import secrets
import time
from datetime import UTC, datetime, tzinfo
from random import Random
from typing import Any

from station.simulation.scheduler import Scheduler

BEGIN_S = datetime(2026, 1, 5, 6, tzinfo=UTC).timestamp()


class Clocks:
    """Replaces the module `time`; the wall clock may be set, the monotonic one continues."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self.set_s = BEGIN_S
        """Offset of the wall clock from the monotonic one."""

    def monotonic(self) -> float:
        return self._scheduler.now_s

    def monotonic_ns(self) -> int:
        return round(self._scheduler.now_s * 1e9)

    def time(self) -> float:
        return self.set_s + self._scheduler.now_s

    def time_ns(self) -> int:
        return round(self.time() * 1e9)

    def sleep(self, seconds: float) -> None:
        self._scheduler.wait(seconds=seconds)

    def __getattr__(self, name: str) -> Any:
        return getattr(time, name)


def dates(clocks: Clocks) -> type[datetime]:
    """A class in place of `datetime`, whose `now` is that of the clocks."""

    class Kind(type):
        def __instancecheck__(cls, instance: object) -> bool:
            return isinstance(instance, datetime)

    class VirtualDatetime(datetime, metaclass=Kind):
        @classmethod
        def now(cls, tz: tzinfo | None = None) -> datetime:  # type: ignore[override]
            return datetime.fromtimestamp(clocks.time(), tz)

    return VirtualDatetime


class DrawnSecrets:
    """Replaces the module `secrets`: not secret, but reproducible from the seed."""

    def __init__(self, random: Random) -> None:
        self._random = random

    def randbits(self, bits: int) -> int:
        return self._random.getrandbits(bits)

    def token_hex(self, count: int) -> str:
        return self._random.randbytes(count).hex()

    def __getattr__(self, name: str) -> Any:
        return getattr(secrets, name)
