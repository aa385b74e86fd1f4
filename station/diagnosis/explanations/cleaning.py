"""Glitches: readings that no explanation accounts for, excluded by id before and after weighing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from station.diagnosis.explanations.frame import added, frame
from station.diagnosis.explanations.noise_level import NoiseLevel
from station.diagnosis.explanations.settle import Settled, settle
from station.diagnosis.explanations.situation import at_readings, predicted
from station.diagnosis.runs_in_time import in_runs
from station.errors import InputRefused
from station.fitting import NotConvergedError, Solution, find_outliers, tolerance_prior
from station.five_bar import FiveBar
from station.mechanism import Reference
from station.model import Model, fit
from station.records import Real

LARGEST_SHARE = 0.1
APPROACH_STEPS = 3
"""Number of steps where the base model has no useful minimum."""
FAR_OFF, WELL_PREDICTED = 5.5, 4.0
"""Standard deviations from the best explanation: beyond the first excluded, within the second taken back."""
Mask = NDArray[np.bool_]


def solved(mechanism: FiveBar, reference: Reference, row_sd: Real) -> Solution:
    """The base model fitted to readings.  :raises NotConvergedError:"""
    return fit(Model(mechanism, reference), tolerance_prior(mechanism), row_sd).solution


def start(mechanism: FiveBar, reference: Reference) -> tuple[Real, Real]:
    """(P,) base parameters near the minimum, and their residual for each reading (K,), mm.

    Where an error is so large that no minimum is found, a few steps towards it are sufficient.
    """
    row_sd = mechanism.row_sd
    try:
        solution = solved(mechanism, reference, row_sd)
    except NotConvergedError:
        p = mechanism.start
        for _ in range(APPROACH_STEPS):
            at = frame(mechanism, p, reference, row_sd)
            p = settle(at, (), (), NoiseLevel(len(row_sd), at.parameters_taken), reference).x
        return p, mechanism.measured - predicted(mechanism, p)
    return solution.x, -solution.residual * row_sd


def suspects(mechanism: FiveBar, reference: Reference) -> Mask:
    """(K,) readings that disagree with the others and with their own position, if few and isolated."""
    m = mechanism.measurements
    none = np.zeros(len(m), dtype=bool)
    try:
        found = find_outliers(mechanism, lambda sd: solved(mechanism, reference, sd), mechanism.row_sd)
    except (NotConvergedError, InputRefused):
        return none
    named = {o.reading for o in found}
    off = np.array([i in named for i in m.ids])
    off &= ~in_runs(m, lambda row: bool(off[row].all()))
    return off if off.sum() <= LARGEST_SHARE * len(m) else none


def judged(mechanism: FiveBar, reference: Reference, best: Settled, row_sd: Real) -> Real:
    """(K,) deviation of all readings of `mechanism` from the best explanation, in standard deviations.

    The scatter of the majority is the reference.
    """
    p = best.x[: best.size]
    more = added(at_readings(mechanism, p, reference), best.present)
    t = np.abs(mechanism.measured - predicted(mechanism, p, more)) / row_sd
    return np.asarray(t / max(1.0, 1.4826 * float(np.median(t))))
