"""The direction that the data hold least, in words, and what would hold it.

The distance leaves three directions exactly blind (both base joints and the mechanism shifted
together in x or y; the whole robot turned about O_1) and the remains of the third weak: both arms
together with a sideways error of the mechanism (method.md section 1).
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from station.fitting import Noise, common_sd_deg
from station.five_bar import KEPT, FiveBar, distance_jacobian, pose
from station.records import Measurements, Real

BLIND = (
    "base joints and mechanism shifted together sideways",
    "base joints and mechanism shifted together in height",
    "the whole robot turned about the mechanism's joint on the base",
)
KNOWN_DRM_SD_MM = 0.02
"""What a careful measurement of the mechanism reaches (method.md section 2)."""
SECOND_MOUNT_MM = 200.0


class Posterior(Protocol):
    """What a fit knows: an identification, or the base parameters of a diagnosis."""

    @property
    def mechanism(self) -> FiveBar: ...
    @property
    def measurements(self) -> Measurements: ...
    @property
    def noise(self) -> Noise: ...
    @property
    def sd_factor(self) -> float: ...
    @property
    def dtheta(self) -> Real: ...
    @property
    def covariance(self) -> Real: ...


def describe_weak_direction(fit: Posterior) -> dict[str, Any]:
    """{singular_ratio, text, sd_deg, blind, remedies}: the contract's `weak_direction`.

    sd_deg is the standard uncertainty of the zero offsets along the weak direction; each remedy
    comes with the sd_deg that it would bring.
    """
    return {
        "singular_ratio": singular_ratio(fit),
        "text": _words(fit),
        "sd_deg": common_sd_deg(fit.covariance),
        "blind": list(BLIND),
        "remedies": remedies(fit),
    }


def singular_ratio(fit: Posterior) -> float:
    """Smallest over largest singular value of the paper's four unknowns, the reading offset taken out."""
    geometry = fit.mechanism.nominal
    rows = distance_jacobian(geometry, pose(geometry, fit.measurements.theta + fit.dtheta))[:, KEPT]
    rows[:, :2] /= geometry.L
    for mount in range(len(fit.measurements.mounts)):
        own = fit.measurements.mount == mount
        rows[own] -= rows[own].mean(axis=0)
    sigma = np.linalg.svd(rows, compute_uv=False)
    return float(sigma[-1] / sigma[0])


def _words(fit: Posterior) -> str:
    """Read off the principal axis of the zero offsets' posterior and what moves with it."""
    C = fit.covariance
    axis = np.linalg.eigh(C[:2, :2])[1][:, -1]
    together = axis[0] * axis[1] > 0
    arms = "both arms together" if together else "one arm against the other"
    prior_sd = np.array([p.prior_sd for p in fit.mechanism.parameters])
    sd = np.sqrt(np.diag(C))
    along = (C[:, :2] @ axis) / (sd * np.sqrt(axis @ C[:2, :2] @ axis))
    side, height = abs(along[10]), abs(along[11])
    undecided = (sd[10:12] > 0.02 * prior_sd[10:12]) & (np.array([side, height]) > 0.5)
    if undecided[0] and side >= height:
        return f"{arms} with a sideways error of the mechanism"
    if undecided[1]:
        return f"{arms} with an error of the mechanism along its height"
    return arms


def remedies(fit: Posterior) -> list[dict[str, Any]]:
    """What would tie the weak direction down, with the sd of the common mode it would bring."""
    finite = np.isfinite(np.diag(fit.covariance))
    information = np.linalg.inv(fit.covariance[np.ix_(finite, finite)])
    known = information.copy()
    for axis in (10, 11):
        known[axis, axis] += 1.0 / KNOWN_DRM_SD_MM**2
    return [
        {
            "text": f"measure the mechanism's mounting error to {KNOWN_DRM_SD_MM} mm",
            "sd_deg": common_sd_deg(np.linalg.inv(known)),
        },
        {
            "text": f"repeat the walk with the mechanism mounted {SECOND_MOUNT_MM:.0f} mm aside",
            "sd_deg": common_sd_deg(_with_second_mount(fit, information)),
        },
    ]


def _with_second_mount(fit: Posterior, information: Real) -> Real:
    """Posterior covariance after the same walk from a second mount with its own dr_M and rho_0."""
    size = len(information)
    geometry = fit.mechanism.nominal
    aside = type(geometry)(geometry.e, geometry.L, geometry.l, geometry.cd + SECOND_MOUNT_MM)
    at = pose(aside, fit.measurements.theta + fit.dtheta)
    rows = np.zeros((len(at.r), size + 3))
    jacobian = distance_jacobian(aside, at)
    rows[:, :10] = jacobian[:, :10]
    rows[:, size : size + 2] = jacobian[:, 10:12]
    rows[:, size + 2] = -1.0
    rows /= fit.noise.row_sd[:, None] * fit.sd_factor
    wider = np.zeros((size + 3, size + 3))
    wider[:size, :size] = information
    wider[[size, size + 1], [size, size + 1]] += 1.0 / np.array(fit.mechanism.robot.drm_sd) ** 2
    return np.asarray(np.linalg.inv(wider + rows.T @ rows))
