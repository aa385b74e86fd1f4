"""Replacements for imports of production code from `threading` and `queue`, over the scheduler."""

from __future__ import annotations

import queue
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from types import TracebackType
from typing import Any, Generic, TypeVar

from station.simulation.scheduler import Scheduler, Task

T = TypeVar("T")


class Threads:
    """Makes the primitives of one world; each has the used part of the real one's interface."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler

    def Thread(  # noqa: N802 - stands in for the class
        self,
        *,
        target: Callable[..., object],
        args: Iterable[Any] = (),
        kwargs: Mapping[str, Any] | None = None,
        name: str = "thread",
        daemon: bool | None = None,
    ) -> VirtualThread:
        given = dict(kwargs or {})
        return VirtualThread(self._scheduler, lambda: target(*args, **given), name)

    def Event(self) -> VirtualEvent:  # noqa: N802
        return VirtualEvent(self._scheduler)

    def Lock(self) -> VirtualLock:  # noqa: N802
        return VirtualLock(self._scheduler)

    def RLock(self) -> VirtualLock:  # noqa: N802
        return VirtualLock(self._scheduler, again=True)

    def Condition(self) -> VirtualCondition:  # noqa: N802
        return VirtualCondition(self._scheduler)

    def Queue(self) -> VirtualQueue[Any]:  # noqa: N802
        return VirtualQueue(self._scheduler)

    def get_ident(self) -> int:
        return id(self._scheduler.running)


class VirtualThread:
    """As `threading.Thread`."""

    def __init__(self, scheduler: Scheduler, run: Callable[[], object], name: str) -> None:
        self.name = name
        self._scheduler, self._run = scheduler, run
        self._task: Task | None = None

    def start(self) -> None:
        self._task = self._scheduler.spawn(self._run, self.name)
        self._scheduler.give_way()

    def join(self, timeout: float | None = None) -> None:
        self._scheduler.wait(lambda: not self.is_alive(), timeout)

    def is_alive(self) -> bool:
        return self._task is not None and not self._task.ended


class VirtualEvent:
    """As `threading.Event`."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._is_set = False

    def is_set(self) -> bool:
        return self._is_set

    def set(self) -> None:
        self._is_set = True
        self._scheduler.give_way()

    def clear(self) -> None:
        self._is_set = False

    def wait(self, timeout: float | None = None) -> bool:
        return self._scheduler.wait(self.is_set, timeout)


class VirtualLock:
    """As `threading.Lock`, or `threading.RLock`."""

    def __init__(self, scheduler: Scheduler, *, again: bool = False) -> None:
        self._scheduler, self._again = scheduler, again
        self._holder: Task | None = None
        self._times = 0

    def acquire(self) -> bool:
        me = self._scheduler.running
        if self._again and self._holder is me:
            self._times += 1
            return True
        if self._holder is not None:
            self._scheduler.wait(lambda: self._holder is None)
        self._holder, self._times = me, 1
        return True

    def release(self) -> None:
        self._times -= 1
        if self._times == 0:
            self._holder = None

    def locked(self) -> bool:
        return self._holder is not None

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.release()


class VirtualCondition(VirtualLock):
    """As `threading.Condition`; the condition is checked whenever other tasks have run."""

    def wait_for(self, predicate: Callable[[], T], timeout: float | None = None) -> T:
        if not (found := predicate()):
            self.release()
            self._scheduler.wait(lambda: bool(predicate()) and self._holder is None, timeout)
            self._holder, self._times = self._scheduler.running, 1
            found = predicate()
        return found

    def notify_all(self) -> None:
        """Nothing to do: no task needs a notification."""


class VirtualQueue(Generic[T]):
    """As `queue.Queue`."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._items: deque[T] = deque()

    def put(self, item: T) -> None:
        self._items.append(item)
        self._scheduler.give_way()

    def get(self, timeout: float | None = None) -> T:
        if not self._scheduler.wait(lambda: bool(self._items), timeout):
            raise queue.Empty
        return self._items.popleft()
