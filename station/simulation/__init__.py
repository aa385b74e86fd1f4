"""Station-years in virtual time: the production code, and everything outside it simulated.

What is simulated: clocks and threads (`scheduler`, `threads`, `clocks`, `loops`), put in the place of the
real ones by `substitution`; the equipment (`site`) and the wires to it (`wires`), the disk's faults and power
cuts (`disk`), receivers of events (`receiver`), people and programs with their requests (`people`,
`clients`).  `plant` puts them together, `days` lets things happen (`jobs`), `witness` says what must hold.
`exhaustive` leaves nothing to a draw where that is possible; `shrinking` finds what a violation takes.
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
