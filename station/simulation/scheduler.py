"""Many threads of which one runs at a time, in virtual time: the seed determines the order of events.

Each task is a thread of the operating system that runs only while it holds the baton. When it has to wait it
passes the baton to a task drawn from those that can continue; if there is none, time advances to the first
one that waits for a time. The same seed gives the same order of all events.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from random import Random

_STACK_BYTES = 4 * 2**20
_TICK_S = 1e-6


class Killed(BaseException):
    """Raised in every task of a process that was killed, at its next call of the scheduler.

    Not an `Exception`: no error handler may catch it.
    """


class Deadlock(RuntimeError):
    """No task can continue, and none waits for a time. Raised in the first task."""


class Process:
    """The tasks of one process of the operating system, which end together."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.killed = False


class Task:
    """One thread."""

    def __init__(self, name: str, process: Process) -> None:
        self.name, self.process = name, process
        self.baton = threading.Semaphore(0)
        self.ready: Callable[[], bool] | None = None
        """The condition it waits for; None: for a time only."""
        self.until_s: float | None = None
        """Virtual time at which it continues in any case; None: never."""
        self.ended = False


class Scheduler:
    """All tasks of one simulated world.  The thread that makes it is its first task."""

    def __init__(self, random: Random) -> None:
        self.now_s = 0.0
        self._random = random
        self._director = self._running = Task("director", Process("world"))
        self._tasks = [self._director]
        self.failures: list[str] = []
        """Threads that ended by an error, and the error."""
        self._dead_end: str | None = None
        self._over = False

    @property
    def running(self) -> Task:
        """The task that holds the baton: the caller."""
        return self._running

    def spawn(self, run: Callable[[], object], name: str, process: Process | None = None) -> Task:
        """Make a new task; it begins when the scheduler selects it.

        :param process: its process; by default that of the caller
        """
        task = Task(name, process or self._running.process)

        def life() -> None:
            task.baton.acquire()
            try:
                if not self._is_killed(task):
                    run()
            except BaseException as error:  # noqa: BLE001 - end of the thread
                if not self._is_killed(task):
                    self.failures.append(f"{name} ended by {type(error).__name__}: {error}")
            finally:
                task.ended = True
                self._tasks.remove(task)
                self._hand_over(self._next())

        threading.stack_size(_STACK_BYTES)
        threading.Thread(target=life, name=name, daemon=True).start()
        task.ready = _at_once
        self._tasks.append(task)
        return task

    def wait(self, ready: Callable[[], bool] | None = None, seconds: float | None = None) -> bool:
        """Let others run until a condition holds, or the time is over. Returns whether it holds.

        :param ready: checks the condition; it must not wait itself
        :param seconds: time limit; None: unlimited
        :raises Killed: the caller's process was killed
        :raises Deadlock: no task can continue
        """
        if seconds is None:
            return self.wait_until(None, ready)
        # a clock has no finer resolution; repeated waits for the remainder of a time would not end
        return self.wait_until(self.now_s + (max(seconds, _TICK_S) if seconds > 0.0 else 0.0), ready)

    def wait_until(self, at_s: float | None, ready: Callable[[], bool] | None = None) -> bool:
        """The same with a time instead of a duration."""
        task = self._running
        self._check_alive(task)
        task.ready, task.until_s = ready, at_s
        following = self._next()
        if following is not task:
            self._hand_over(following)
            task.baton.acquire()
        if self._dead_end is not None and task is self._director:
            said, self._dead_end = self._dead_end, None
            raise Deadlock(said)
        self._check_alive(task)
        return ready is not None and ready()

    def give_way(self) -> None:
        """Let others run first, if the draw decides so: a point where threads may overtake each other."""
        self.wait(_at_once)

    def kill(self, process: Process) -> None:
        """End a process as the operating system does; returns when none of its tasks remains."""
        process.killed = True
        self.wait(lambda: not self.tasks_of(process))

    def end(self) -> None:
        """End every task but the first, which is the caller's."""
        self._over = True
        self.wait(lambda: self._tasks == [self._director])

    def tasks_of(self, process: Process) -> list[Task]:
        """Those that have not ended."""
        return [task for task in self._tasks if task.process is process]

    def _check_alive(self, task: Task) -> None:
        if self._is_killed(task):
            raise Killed

    def _is_killed(self, task: Task) -> bool:
        return task.process.killed or (self._over and task is not self._director)

    def _hand_over(self, task: Task) -> None:
        self._running = task
        task.baton.release()

    def _next(self) -> Task:
        over, director = self._over, self._director
        able = [
            task
            for task in self._tasks
            if task.process.killed  # called several hundred thousand times a day, so all in one place
            or (over and task is not director)
            or (task.ready is not None and task.ready())
        ]
        if not able:
            waiting = [task for task in self._tasks if task.until_s is not None]
            if not waiting:
                names = ", ".join(task.name for task in self._tasks)
                self._dead_end = f"Nothing can go on at {self.now_s:.3f} s: {names} wait for each other."
                return self._director
            first_s = min(task.until_s for task in waiting if task.until_s is not None)
            self.now_s = max(self.now_s, first_s)
            able = [task for task in waiting if task.until_s == first_s]
        return able[0] if len(able) == 1 else self._random.choice(able)


def _at_once() -> bool:
    return True
