"""Uncertainty of a searched parameter (cycles per turn, a period), from the effect of a small change."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.diagnosis.explanations.frame import Frame
from station.diagnosis.explanations.settle import Settled
from station.records import Quantity

STEP = 1e-4
"""Relative change by which the derivative is taken."""


def with_searched(
    at: Frame, settled: Settled, index: int, quantities: tuple[Quantity, ...]
) -> tuple[Quantity, ...]:
    """The quantities of one error with a standard uncertainty for the searched parameters."""
    family, member = settled.families[index], settled.choices[index].member
    hidden = family.hidden[member]
    if family.neighbours is None or not any(q.name in hidden for q in quantities):
        return quantities
    return tuple(
        replace(q, sd=_sd(at, settled, index, q.name)) if q.name in hidden else q for q in quantities
    )


def _sd(at: Frame, settled: Settled, index: int, name: str) -> float:
    family, member = settled.families[index], settled.choices[index].member
    value = family.hidden[member][name]
    step = STEP * abs(value)
    low, high = (
        at.signature(replace(family, hidden=({**family.hidden[member], name: value + by},)))[0]
        @ settled.amplitudes[index]
        for by in (-step, step)
    )
    known = np.hstack(
        [
            at.whiten(at.signature(f, c.member)[0].T).T
            for f, c in zip(settled.families, settled.choices, strict=True)
        ]
    )
    slope = at.whiten((high - low) / (2.0 * step))
    left = slope - known @ np.linalg.lstsq(known, slope, rcond=None)[0]
    return settled.level / max(float(np.linalg.norm(left)), 1e-12)
