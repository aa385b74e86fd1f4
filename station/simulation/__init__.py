"""Station-years in virtual time: the production code, and everything outside it simulated.

What is simulated: clocks and threads (`scheduler`, `threads`, `clocks`), put in the place of the real ones
by `substitution`; wires to the emulated devices (`wires`), the disk's faults and power cuts (`disk`), the
receiver of events (`receiver`).  `plant` puts them together, `days` lets things happen, `witness` says what
must hold.  `exhaustive` leaves nothing to a draw where that is possible.
"""

from __future__ import annotations

from station.simulation.exhaustive import (
    Case,
    Outcome,
    carried_out,
    orders,
    writes_that_fail,
)
from station.simulation.witness import INVARIANTS, Violation
from station.simulation.years import Life, happenings, live, month, months

__all__ = [
    "INVARIANTS",
    "Case",
    "Life",
    "Outcome",
    "Violation",
    "carried_out",
    "happenings",
    "live",
    "month",
    "months",
    "orders",
    "writes_that_fail",
]
