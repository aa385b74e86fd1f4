"""Readings so far off that they are excluded before anything is searched: a plain fit follows them.

A fit of few readings bends to one that is far off, until its neighbours look wrong as well and none is named.
An effect of the catalogue spreads over many readings; none of them is this far from a robust fit.
"""

from __future__ import annotations

from station.fitting import (
    NotConvergedError,
    Outlier,
    Prior,
    Solution,
    few_enough,
    find_outliers,
    outliers_of_fit,
)
from station.mechanism import Mechanism, reference_of
from station.model import Model, fit
from station.records import Real

GROSS = 10.0
"""Scatter of the other readings, times this: beyond it a reading is gross."""


def gross_readings(mechanism: Mechanism, prior: Prior) -> tuple[Outlier, ...]:
    """Those readings; none if they are too many, or if the fit cannot start."""
    model = Model(mechanism, reference_of(mechanism.measurements))

    def solved(row_sd: Real) -> Solution:
        return fit(model, prior, row_sd).solution

    try:
        plain = outliers_of_fit(mechanism, solved(mechanism.row_sd), mechanism.row_sd)
        if not any(o.times_sd > GROSS for o in plain):
            return ()
        found = find_outliers(mechanism, solved, mechanism.row_sd)
    except NotConvergedError:
        return ()
    gross = tuple(o for o in found if o.times_sd > GROSS)
    return gross if few_enough(gross, len(mechanism.measurements)) else ()
