"""A month with a violation, reduced by all jobs that do not contribute to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from station.errors import InputRefused
from station.simulation.days import DEEDS, TROUBLES
from station.simulation.jobs import Job, Script
from station.simulation.witness import Violation
from station.simulation.years import DAYS_A_MONTH, Life, live

Item = TypeVar("Item")


@dataclass(frozen=True, slots=True)
class Shrunk:
    """The reduced month."""

    seed: int
    jobs: tuple[Job, ...]
    violation: Violation
    lives: int
    """Number of simulated months."""


def shrunk(
    seed: int,
    days: int = DAYS_A_MONTH,
    deeds: Mapping[str, float] = DEEDS,
    troubles: Mapping[str, float] = TROUBLES,
) -> Shrunk:
    """The fewest jobs that still violate the invariant violated first, with the fewest disturbances.

    :raises InputRefused: there is no violation in this month
    """
    lives = 0

    def lived(jobs: Sequence[Job]) -> Life:
        nonlocal lives
        lives += 1
        kept = frozenset((job.day, job.number) for job in jobs)
        calm = frozenset((job.day, job.number) for job in jobs if job.trouble == "none")
        return live(seed, days, deeds, troubles, Script(kept, calm))

    whole = live(seed, days, deeds, troubles)
    if not whole.violations:
        raise InputRefused(f"Everything holds in month {seed}; there is nothing to shrink.")
    broken = whole.violations[0].invariant

    def breaks(jobs: Sequence[Job]) -> bool:
        return any(violation.invariant == broken for violation in lived(jobs).violations)

    jobs = smallest(whole.jobs, breaks)
    for number, job in enumerate(jobs):
        calm = [*jobs[:number], replace(job, trouble="none"), *jobs[number + 1 :]]
        if job.trouble != "none" and breaks(calm):
            jobs = calm
    violations = lived(jobs).violations
    first = next((v for v in violations if v.invariant == broken), whole.violations[0])
    return Shrunk(seed, tuple(jobs), first, lives)


def smallest(items: Sequence[Item], breaks: Callable[[Sequence[Item]], bool]) -> list[Item]:
    """Items none of which can be omitted, in order (delta debugging, Zeller and Hildebrandt 2002).

    :param items: items that together cause the violation
    """
    left, parts = list(items), 2
    while len(left) > 1:
        size = -(-len(left) // parts)
        without = [[*left[:k], *left[k + size :]] for k in range(0, len(left), size)]
        found = next((few for few in without if breaks(few)), None)
        if found is not None:
            left, parts = found, max(2, parts - 1)
        elif size == 1:
            break
        else:
            parts = min(len(left), 2 * parts)
    return left
