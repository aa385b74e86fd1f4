"""Whether references agree with all other data: each is compared with the result without it."""

from __future__ import annotations

import numpy as np
from scipy.special import ndtr

from station.fitting import Solution
from station.five_bar import FiveBar, measured_value
from station.records import AnyReference, MountingError, ReferenceUse

ALONE = 1e-9
"""Share of the information on an unknown below which only the reference determines it."""
CONTRADICTS_P = 1e-4
"""Probability that a correct reference is refused."""


def reference_uses(
    mechanism: FiveBar, solution: Solution, remembered: tuple[MountingError, ...] = ()
) -> tuple[ReferenceUse, ...]:
    """Each reference of the mechanism's robot against the fit that it was used in.

    :param remembered: those that the memory contains, which cannot be separated from it any more
    """
    uses = [
        _use(mechanism, solution, reference)
        for reference in mechanism.robot.references
        if reference not in remembered
    ]
    return tuple(uses)


def _use(mechanism: FiveBar, solution: Solution, reference: AnyReference) -> ReferenceUse:
    """The difference from the other data follows from the posterior: information is additive."""
    names = [p.name for p in mechanism.parameters]
    i = names.index(reference.parameter)
    value, sd = measured_value(reference, mechanism.robot)
    x, variance = float(solution.x[i]), float(solution.covariance[i, i])
    rest = 1.0 / variance - 1.0 / sd**2
    shown, unit = mechanism.parameters[i].shown, mechanism.parameters[i].unit
    if rest * variance < ALONE:
        return ReferenceUse(reference=reference, residual=None, sd=None, unit=unit, p_value=1.0)
    without = (x / variance - value / sd**2) / rest
    difference, spread = value - without, float(np.sqrt(sd**2 + 1.0 / rest))
    return ReferenceUse(
        reference=reference,
        residual=difference * shown,
        sd=spread * shown,
        unit=unit,
        p_value=float(2.0 * ndtr(-abs(difference) / spread)),
    )


def contradicted(uses: tuple[ReferenceUse, ...]) -> ReferenceUse | None:
    """The reference that agrees least with the other data, if it is not credible."""
    doubtful = [use for use in uses if use.p_value is not None and use.p_value < CONTRADICTS_P]
    return min(doubtful, key=lambda use: use.p_value or 0.0, default=None)
