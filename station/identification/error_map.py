"""The position error of an identified machine over its workspace, and the fresh readings that verified it."""

from __future__ import annotations

import numpy as np

from station.fitting import ErrorFields, error_bounds, position_error_field
from station.five_bar import FiveBar
from station.identification.estimate import Identification
from station.records import Complex, FreshReading, Measurements, Real


def error_fields(found: Identification[FiveBar], zeros: Real, places: Complex) -> ErrorFields:
    """Errors at positions (G,), mm, commanded by nominal inverse position.

    :param zeros: (2,) rad, taken out by the drives afterwards
    :raises Unreachable: naming the first position out of reach.
    """
    mechanism, covariance = found.mechanism, found.covariance
    after = found.p.copy()
    after[:2] -= zeros
    old, new = (mechanism.position_errors_at(p, places) for p in (found.p, after))
    return ErrorFields(
        before=position_error_field(*old, covariance),
        after=position_error_field(*new, covariance),
        after_95=error_bounds(*new, covariance),
    )


def fresh_readings(
    found: Identification[FiveBar], fresh: Measurements, residual_mm: Real
) -> tuple[FreshReading, ...]:
    """Readings that were not used in the fit, with their residuals (K,) and the positions of the platform."""
    places = FiveBar(found.mechanism.robot, fresh).places(found.p)
    return tuple(
        FreshReading(reading=int(i), x_mm=float(x), y_mm=float(y), residual_mm=float(r))
        for i, (x, y), r in zip(fresh.ids, np.asarray(places), residual_mm, strict=True)
    )
