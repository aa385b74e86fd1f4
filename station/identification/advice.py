"""Measures that would improve a calibration, with gain and duration: millimetres and minutes.

Each is information added to the posterior, linear about the fit. Measures without a benefit are not listed.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from station.five_bar import KNOWN_DRM_SD_MM, SECOND_MOUNT_MM, FiveBar, with_second_mount
from station.identification.bound import expected_bound_mm
from station.identification.estimate import Identification
from station.records import Advice, Real

LEVEL_SD_DEG = 0.005
LEAST_SHARE = 0.03
"""Share of the bound; a smaller gain is not reported."""
READING_S = 0.4
MINUTES = {"joint_angle": 3.0, "drm_x": 10.0, "second_mount": 15.0}


def advice_of(found: Identification[FiveBar]) -> tuple[Advice, ...]:
    """Best gain per minute first."""
    now = _bound(found, found.covariance)
    advice = []
    for kind, text, joint, minutes, covariance in _possible(found):
        gain_mm = now - _bound(found, covariance)
        if np.isfinite(gain_mm) and gain_mm > LEAST_SHARE * now:
            advice.append(Advice(kind=kind, text=text, joint=joint, gain_mm=float(gain_mm), minutes=minutes))
    return tuple(sorted(advice, key=lambda one: one.gain_mm / one.minutes, reverse=True))


def _possible(found: Identification[FiveBar]) -> Iterator[tuple[str, str, int | None, float, Real]]:
    """Kind, text, joint, minutes, and the resulting covariance (P, P)."""
    information = np.linalg.inv(found.covariance)
    names = [p.name for p in found.mechanism.parameters]
    readings = len(found.measurements)
    J = found.solution.jacobian / found.sd_factor
    again = np.linalg.inv(information + J.T @ J)
    yield (
        "repeat",
        f"Measure the same {readings} readings once more.",
        None,
        readings * READING_S / 60.0,
        again,
    )
    level = float(np.radians(np.hypot(LEVEL_SD_DEG, found.mechanism.robot.joint_sd_deg)))
    for joint in (1, 2):
        text = f"Read the angle of joint {joint} from a level, to {LEVEL_SD_DEG}°."
        covariance = _told(information, names.index(f"dtheta{joint}"), level)
        yield "joint_angle", text, joint, MINUTES["joint_angle"], covariance
    text = f"Measure the mechanism's mounting error sideways, to {KNOWN_DRM_SD_MM} mm."
    yield "drm_x", text, None, MINUTES["drm_x"], _told(information, names.index("rMx"), KNOWN_DRM_SD_MM)
    if len(found.measurements.mounts) == 1:
        text = f"Measure from a second mounting point, {SECOND_MOUNT_MM:.0f} mm aside."
        covariance = with_second_mount(
            found.mechanism, found.noise.row_sd * found.sd_factor, found.dtheta, information
        )
        yield "second_mount", text, None, MINUTES["second_mount"], covariance[: len(names), : len(names)]


def _told(information: Real, index: int, sd: float) -> Real:
    """(P, P) covariance with one unknown measured."""
    told = information.copy()
    told[index, index] += 1.0 / sd**2
    return np.asarray(np.linalg.inv(told))


def _bound(found: Identification[FiveBar], covariance: Real) -> float:
    """The bound with the zeros in the drives only: later knowledge of the geometry changes nothing."""
    p = found.p.copy()
    p[:2] = 0.0
    return expected_bound_mm(*found.mechanism.position_errors(p), found.covariance, covariance)
