"""The tolerances of a robot file as the prior of a fit."""

from __future__ import annotations

import numpy as np

from station.fitting.least_squares import Prior
from station.mechanism import Mechanism


def tolerance_prior(mechanism: Mechanism) -> Prior:
    """The tolerances of the robot file as the prior of every parameter."""
    return Prior.independent(
        np.array([p.prior_mean for p in mechanism.parameters]),
        np.array([p.prior_sd for p in mechanism.parameters]),
    )
