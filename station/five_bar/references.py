"""References as measurements of single unknowns: their values, and the knowledge that results from them.

A reference y of an unknown x with standard uncertainty s is one more row (y - x) / s of the fit.  Where the
prior of x is independent of the other unknowns, that is the product of two normal distributions (GUM, H.2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from station.five_bar.robot_file import Robot
from station.mechanism import Parameter
from station.records import AnyReference, JointAngle


def measured_value(reference: AnyReference, robot: Robot) -> tuple[float, float]:
    """Value and standard uncertainty of the unknown that a reference measures, rad or mm."""
    if isinstance(reference, JointAngle):
        # the reference is counted from the feedback, which has an uncertainty of its own
        sd_deg = float(np.hypot(reference.sd_deg, robot.joint_sd_deg))
        return float(np.radians(reference.offset_deg)), float(np.radians(sd_deg))
    return reference.value_mm, reference.sd_mm


def with_references(parameters: Sequence[Parameter], robot: Robot) -> tuple[Parameter, ...]:
    """The unknowns of a robot, updated with its references."""
    if not robot.references:
        return tuple(parameters)
    out = {p.name: p for p in parameters}
    for reference in robot.references:
        value, sd = measured_value(reference, robot)
        known = out[reference.parameter]
        share = known.prior_sd**2 / (known.prior_sd**2 + sd**2)
        out[known.name] = replace(
            known,
            prior_mean=known.prior_mean + share * (value - known.prior_mean),
            prior_sd=float(np.sqrt(share)) * sd,
        )
    return tuple(out.values())
