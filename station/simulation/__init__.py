"""Station-years in virtual time: the production code, with a simulation of everything outside it.

Simulated are clocks and threads (`scheduler`, `threads`, `clocks`, `loops`), put in place of the real ones by
`substitution`; the equipment (`site`) and the wires to it (`wires`), faults of the disk and power failures
(`disk`), receivers of events (`receiver`), people and programs with their requests (`people`, `clients`).
`plant` combines them, `days` generates events (`jobs`), `witness` checks the invariants. `exhaustive` covers
small cases completely without random draws; `shrinking` finds a minimal example of a violation.
"""

from __future__ import annotations

from station.simulation.exhaustive import (
    Case,
    Outcome,
    carried_out,
    orders,
    writes_that_fail,
)
from station.simulation.shrinking import Shrunk, shrunk
from station.simulation.witness import INVARIANTS, Violation
from station.simulation.years import Life, happenings, live, month, months

__all__ = [
    "INVARIANTS",
    "Case",
    "Life",
    "Outcome",
    "Shrunk",
    "Violation",
    "carried_out",
    "happenings",
    "live",
    "month",
    "months",
    "orders",
    "shrunk",
    "writes_that_fail",
]
