"""The predicted accuracy from one reading at each of some positions, by specification."""

from __future__ import annotations

import numpy as np

from station.fitting import largest_error_bound, position_error_summary, tolerance_prior
from station.five_bar import FiveBar, Robot, common_sd_deg, inverse, with_second_mount
from station.records import Complex, Measurements, PlanPrediction, PredictedSd, Real

FLAT_PRIOR_SD_MM = 1e4
"""Prior of an unknown reading offset while designing."""


def predict(robot: Robot, places: Complex, samples: int = 1, *, mounts: int = 1) -> PlanPrediction:
    """Predicted accuracy from one reading at each of positions (K,), by specification.

    :param samples: number of samples of the head in the mean of a reading
    :param mounts: 2: the same readings are taken from a second mounting point, too
    """
    mechanism = measured_at(robot, places, samples)
    rows = information_rows(mechanism)
    information = known_beforehand(mechanism) + rows.T @ rows
    covariance = np.linalg.inv(information)
    if mounts == 2:
        size = len(information)
        covariance = with_second_mount(mechanism, mechanism.row_sd, np.zeros(2), information)[:size, :size]
    mean = mechanism.start
    error, jacobian = mechanism.position_errors(mean)
    sd = np.degrees(np.sqrt(np.diag(covariance)[:2]))
    sd_mm = np.sqrt(np.einsum("gdi,ij,gdj->g", jacobian, covariance, jacobian))
    return PlanPrediction(
        zero_offset_sd_deg=(float(sd[0]), float(sd[1])),
        common_sd_deg=common_sd_deg(covariance),
        position_error_mm=position_error_summary(np.zeros_like(error), jacobian, covariance),
        bound_95_mm=largest_error_bound(np.zeros_like(error), jacobian, zeros_only(mechanism, covariance)),
        map=tuple(
            PredictedSd(x_mm=float(r.real), y_mm=float(r.imag), sd_mm=float(s))
            for r, s in zip(mechanism.workspace, sd_mm, strict=True)
        ),
    )


def zeros_only(mechanism: FiveBar, covariance: Real) -> Real:
    """(P, P) of the errors that remain when the drives get the zeros of a fit with covariance (P, P).

    The geometry retains all of its error, known or not.
    """
    left = covariance.copy()
    for i, parameter in enumerate(mechanism.parameters):
        if parameter.role == "geometry":
            left[i, 2:10] = 0.0
            left[i, i] = parameter.prior_sd**2
    return left


def measured_at(robot: Robot, places: Complex, samples: int = 1) -> FiveBar:
    """The mechanism as if readings had been taken at these positions."""
    count = len(places)
    return FiveBar(
        robot,
        Measurements(
            ids=tuple(range(count)),
            t_s=np.zeros(count),
            theta=inverse(robot.geometry, places),
            approach=np.zeros((count, 2), dtype=np.int8),
            distance=np.zeros(count),
            position=np.arange(count),
            mount=np.zeros(count, dtype=np.intp),
            samples=np.full(count, samples, dtype=np.intp),
        ),
    )


def information_rows(mechanism: FiveBar) -> Real:
    """(R, P) derivatives of the readings, in units of their noise."""
    mean = mechanism.start
    at = mechanism.observe(mean, mechanism.theta)
    return np.asarray(at.by_parameter / mechanism.row_sd[:, None])


def known_beforehand(mechanism: FiveBar) -> Real:
    """(P, P) information of the tolerances."""
    root = tolerance_prior(mechanism).root
    information = root.T @ root
    flat = np.diag(information) == 0.0
    information[flat, flat] = 1.0 / FLAT_PRIOR_SD_MM**2
    return np.asarray(information)
