"""The learned curve of each joint for a chart: with its uncertainty and the measurements of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from station.effects import GearCurve, curve_basis, fast_basis
from station.model import Fit
from station.records import JointCurve, Real, visited_ranges

STEP_DEG = 0.5
BIN_DEG = 2.0
FEWEST = 4
"""Minimum number of readings in a bin for which their mean is drawn."""


@dataclass(frozen=True)
class Curve:
    """Error of a joint over the angles visited; fewer than four cycles per turn belong to the geometry."""

    label: str
    joint: int
    angle_deg: Real
    """(G,)"""
    value_deg: Real
    """(G,)"""
    sd_deg: Real
    """(G,)"""
    binned_angle_deg: Real
    """(B,) bins of the joint's angle"""
    binned_deg: Real
    """(B,) mean curve value from the readings in each bin, with everything else in the model correct."""

    def record(self) -> JointCurve:
        """The curve as the document contains it."""
        return JointCurve(
            joint=self.joint,
            angle_deg=tuple(np.round(self.angle_deg, 3).tolist()),
            value_deg=tuple(np.round(self.value_deg, 6).tolist()),
            sd_deg=tuple(np.round(self.sd_deg, 6).tolist()),
        )


def curves(fit: Fit, sd_factor: float = 1.0) -> tuple[Curve, ...]:
    """The curve of each joint that has one in the model."""
    return tuple(
        _curve(fit, k, term.effect, sd_factor)
        for k, term in enumerate(fit.model.terms)
        if isinstance(term.effect, GearCurve)
    )


def _curve(fit: Fit, k: int, effect: GearCurve, sd_factor: float) -> Curve:
    i = effect.index
    amplitudes, covariance = fit.amplitudes(k)
    theta = fit.conditions.theta[:, i]
    parts = [
        np.arange(np.degrees(low), np.degrees(high), STEP_DEG)
        for low, high in visited_ranges(theta[:, None])[0]
    ]
    angle = np.radians(np.concatenate(parts))
    size = len(amplitudes)
    basis = fast_basis(angle, size)
    sd = sd_factor * np.sqrt(np.einsum("ki,ki->k", basis @ covariance, basis))
    slow = (curve_basis(angle, size) - basis) @ amplitudes
    # the remaining residual of each reading, seen as an error of this joint alone, added to the curve
    J = fit.at.by_joint[:, i]
    reading = fit.model.mechanism.reading_of_row
    weight = np.bincount(reading, J**2)
    seen = np.bincount(reading, J * fit.residual_mm) / np.maximum(weight, 1e-12)
    partial = curve_basis(theta, size) @ amplitudes + seen - np.interp(theta, angle, slow)
    cell = np.floor(np.degrees(theta) / BIN_DEG).astype(int)
    number, inverse, count = np.unique(cell, return_inverse=True, return_counts=True)
    total = np.bincount(inverse, weight)
    mean = np.bincount(inverse, weight * partial) / np.maximum(total, 1e-12)
    full = count >= FEWEST
    return Curve(
        effect.label,
        i + 1,
        np.degrees(angle),
        np.degrees(basis @ amplitudes),
        np.degrees(sd),
        (number[full] + 0.5) * BIN_DEG,
        np.degrees(mean[full]),
    )
