"""The direction that the data determine least, in words, and the measurements that would determine it.

The distance leaves three directions exactly blind (both base joints and the mechanism shifted together in x
or y; the whole robot turned about O_1) and the remainder of the third weak: both arms together with a
sideways error of the mechanism.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from station.five_bar.error_model import KEPT, distance_jacobian, pose
from station.five_bar.mechanism import FiveBar
from station.records import Phrase, Real, Remedy, WeakDirection, phrase

if TYPE_CHECKING:  # modules that list runs need robot files, but no solver, which takes long to load
    from station.fitting import Solution

BLIND = (phrase("blind_sideways"), phrase("blind_height"), phrase("blind_turned"))
KNOWN_DRM_SD_MM = 0.02
"""Uncertainty that a careful measurement of the mechanism achieves."""
SECOND_MOUNT_MM = 200.0


@dataclass(frozen=True)
class Posterior:
    """The posterior of a five-bar fit."""

    mechanism: FiveBar
    row_sd: Real
    """(K,) mm, scatter of the readings, lack of fit included."""
    dtheta: Real
    """(2,) rad"""
    covariance: Real
    """(P, P) of the base parameters, lack of fit included."""


def describe_weak_direction(
    mechanism: FiveBar, solution: Solution, row_sd: Real, sd_factor: float
) -> WeakDirection:
    """The contract's `weak_direction`, with or without effects in the model.

    sd_deg is the standard uncertainty of the zero offsets along the weak direction; each remedy includes the
    resulting sd_deg.
    """
    size = len(mechanism.parameters)
    fit = Posterior(
        mechanism,
        row_sd * sd_factor,
        solution.x[:2],
        solution.covariance[:size, :size] * sd_factor**2,
    )
    found = remedies(fit)
    said = _words(fit)
    best, sd_deg = min(found, key=lambda one: one[1])
    advice = phrase("with_sd", remedy=best, sd_deg=sd_deg)
    return WeakDirection(
        singular_ratio=singular_ratio(fit),
        text=said.text(),
        said=said,
        sd_deg=common_sd_deg(fit.covariance),
        blind=tuple(one.text() for one in BLIND),
        blind_said=BLIND,
        remedies=tuple(Remedy(text=said.text(), said=said, sd_deg=sd_deg) for said, sd_deg in found),
        remedy=advice.text(),
        remedy_said=advice,
    )


def singular_ratio(fit: Posterior) -> float:
    """Smallest over largest singular value of the paper's four unknowns, the reading offset taken out."""
    geometry = fit.mechanism.nominal
    rows = distance_jacobian(geometry, pose(geometry, fit.mechanism.measurements.theta + fit.dtheta))[:, KEPT]
    rows[:, :2] /= geometry.L
    for mount in range(len(fit.mechanism.measurements.mounts)):
        own = fit.mechanism.measurements.mount == mount
        rows[own] -= rows[own].mean(axis=0)
    sigma = np.linalg.svd(rows, compute_uv=False)
    return float(sigma[-1] / sigma[0])


def _words(fit: Posterior) -> Phrase:
    """The description, from the principal axis of the zero offsets' posterior and its correlations."""
    C = fit.covariance
    axis = np.linalg.eigh(C[:2, :2])[1][:, -1]
    together = axis[0] * axis[1] > 0
    arms = phrase("arms_together") if together else phrase("arms_against")
    prior_sd = np.array([p.prior_sd for p in fit.mechanism.parameters])
    sd = np.sqrt(np.diag(C))
    along = (C[:, :2] @ axis) / (sd * np.sqrt(axis @ C[:2, :2] @ axis))
    side, height = abs(along[10]), abs(along[11])
    undecided = (sd[10:12] > 0.02 * prior_sd[10:12]) & (np.array([side, height]) > 0.5)
    if undecided[0] and side >= height:
        return phrase("arms_with_sideways", arms=arms)
    if undecided[1]:
        return phrase("arms_with_height", arms=arms)
    return arms


def remedies(fit: Posterior) -> tuple[tuple[Phrase, float], ...]:
    """Measurements that would determine the weak direction, with the resulting sd of the common mode."""
    finite = np.isfinite(np.diag(fit.covariance))
    information = np.linalg.inv(fit.covariance[np.ix_(finite, finite)])
    known = information.copy()
    for axis in (10, 11):
        known[axis, axis] += 1.0 / KNOWN_DRM_SD_MM**2
    return (
        (phrase("measure_mounting", mm=KNOWN_DRM_SD_MM), common_sd_deg(np.linalg.inv(known))),
        (
            phrase("mount_aside", mm=SECOND_MOUNT_MM),
            common_sd_deg(with_second_mount(fit.mechanism, fit.row_sd, fit.dtheta, information)),
        ),
    )


def with_second_mount(mechanism: FiveBar, row_sd: Real, dtheta: Real, information: Real) -> Real:
    """(P + 3, P + 3) covariance after the same readings from a second mount with its own dr_M and rho_0.

    row_sd (K,) mm, dtheta (2,) rad, information (P, P) of the prior.
    """
    size = len(information)
    geometry = mechanism.nominal
    aside = type(geometry)(geometry.e, geometry.L, geometry.l, geometry.cd + SECOND_MOUNT_MM)
    at = pose(aside, mechanism.measurements.theta + dtheta)
    rows = np.zeros((len(at.r), size + 3))
    jacobian = distance_jacobian(aside, at)
    rows[:, :10] = jacobian[:, :10]
    rows[:, size : size + 2] = jacobian[:, 10:12]
    rows[:, size + 2] = -1.0
    rows /= row_sd[:, None]
    wider = np.zeros((size + 3, size + 3))
    wider[:size, :size] = information
    wider[[size, size + 1], [size, size + 1]] += 1.0 / np.array(mechanism.robot.drm_sd) ** 2
    return np.asarray(np.linalg.inv(wider + rows.T @ rows))


def common_sd_deg(covariance: Real) -> float:
    """sd of the mode in which both zero offsets move together."""
    return float(np.degrees(np.sqrt(covariance[:2, :2].sum()) / 2.0))
