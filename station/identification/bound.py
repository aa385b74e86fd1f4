"""The 95 % bound on the largest position error over the workspace, and whether the requirement is met."""

from __future__ import annotations

import numpy as np

from station.fitting import expected_largest_error_bound, largest_error_bounds
from station.five_bar import FiveBar
from station.identification.estimate import Identification
from station.records import AccuracyReached, CalibrationResult, Phrase, Real, because, phrase

PLAN_ENDED = phrase("plan_ended")
GEOMETRY = slice(2, 10)
"""Indices of the geometry among the unknowns."""
LEARNED = 8
"""Number of draws of the possible new knowledge, each used with both signs."""


def bounds_mm(found: Identification[FiveBar], zeros: Real | None = None) -> tuple[float, float]:
    """The bounds with the zeros in the drives only, and with the commands of the identified model.

    :param zeros: (2,) rad, taken out of the drives; by default as identified
    """
    p = found.p.copy()
    p[:2] -= found.dtheta if zeros is None else zeros
    error, jacobian = found.mechanism.position_errors(p)
    by_drives, by_model = largest_error_bounds((error, np.zeros_like(error)), jacobian, found.covariance)
    return by_drives, by_model


def expected_bound_mm(error: Real, jacobian: Real, now: Real, later: Real) -> float:
    """The bound that further measurements are expected to leave, zeros in the drives only.

    It is the mean over the possible outcomes: the identified geometry moves by the part that its covariance
    loses.

    :param error: (G, 2) over the workspace with the zeros taken out, mm
    :param jacobian: (G, 2, P)
    :param now: (P, P) covariance before them
    :param later: (P, P) after them
    """
    values, vectors = np.linalg.eigh((now - later)[GEOMETRY, GEOMETRY])
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    drawn = root @ np.random.default_rng(0).standard_normal((len(values), LEARNED))
    learned = np.einsum("gdi,im->mgd", jacobian[:, :, GEOMETRY], np.hstack([drawn, -drawn]))
    return expected_largest_error_bound(error + learned, jacobian, later)


def accuracy_of(
    found: Identification[FiveBar],
    wanted_mm: float | None,
    *,
    stopped: Phrase = PLAN_ENDED,
    zeros: Real | None = None,
) -> AccuracyReached:
    """The predicted accuracy of a fit, with the required accuracy."""
    by_drives, by_model = bounds_mm(found, zeros)
    return AccuracyReached.of(by_drives, by_model, wanted_mm, stopped)


def with_accuracy(
    result: CalibrationResult, accuracy: AccuracyReached, possible_mm: float | None = None
) -> CalibrationResult:
    """The result, without a pass if the requirement is not met, or the bound cannot be computed.

    :param possible_mm: bound that further readings could reach; by default the bound that was reached
    """
    result = result.model_copy(update={"accuracy": accuracy})
    if result.verdict != "pass" or accuracy.reached is not False:
        return result
    wanted_mm = accuracy.wanted_mm or 0.0
    if accuracy.bound_95_mm is None:
        reason = because("accuracy_unknown", wanted_mm=wanted_mm)
    elif possible_mm is not None and possible_mm < accuracy.bound_95_mm:
        reason = because("accuracy_out_of_reach", wanted_mm=wanted_mm, possible_mm=possible_mm)
    else:
        reason = because("not_accurate_enough", wanted_mm=wanted_mm, possible_mm=accuracy.bound_95_mm)
    return result.model_copy(update={"verdict": "fail", "outcome": "not_accurate_enough", "reason": reason})
