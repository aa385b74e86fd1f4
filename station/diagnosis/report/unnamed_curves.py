"""The unnamed error of a joint for a chart: over the angles visited."""

from __future__ import annotations

import numpy as np

from station.diagnosis.explanations import TARGETS, ExplanationSet, Settled
from station.diagnosis.report.joint_curves import Curve
from station.records import Real

SHOWN = 0.05
"""Minimum probability for which an unnamed error of a joint is drawn."""
SAME_ANGLE_DEG = 0.5
"""Readings within this angle are one point of the curve."""
JOINTS = (1, 2)


def unnamed_curves(found: ExplanationSet) -> tuple[Curve, ...]:
    """Curve of each joint with an unnamed error, averaged over the explanations that contain one."""
    return tuple(curve for joint in JOINTS if (curve := _curve(found, joint)) is not None)


def _curve(found: ExplanationSet, joint: int) -> Curve | None:
    mixture = found.mixture
    held = [
        (weight, *at)
        for settled, weight in zip(mixture.settled, mixture.weight, strict=True)
        if (at := _at_readings(found, settled, joint)) is not None
    ]
    share = sum(weight for weight, _, _ in held)
    if share < SHOWN:
        return None
    mean = sum(w * value for w, value, _ in held) / share
    variance = sum(w * (var + (value - mean) ** 2) for w, value, var in held) / share
    s = mixture.situation
    angle = np.degrees(s.theta[:, joint - 1])
    # the remaining residual of each reading, seen as an error of this joint alone, added to the curve
    by_joint = s.by_target[:, 0, joint - 1]
    residual_mm, _ = found.left_by(mixture.mechanism)
    cell = np.floor(angle / SAME_ANGLE_DEG).astype(int)
    _, point = np.unique(cell, return_inverse=True)
    weight = by_joint**2
    seen = mean + np.bincount(point, by_joint * residual_mm)[point] / np.bincount(point, weight)[point]

    def at_points(values: Real) -> Real:
        return np.asarray(np.bincount(point, values) / np.bincount(point))

    return Curve(
        f"unnamed error of joint {joint}",
        joint,
        at_points(angle),
        np.degrees(at_points(mean)),
        np.degrees(np.sqrt(at_points(variance))),
        at_points(angle),
        np.degrees(at_points(seen)),
    )


def _at_readings(found: ExplanationSet, settled: Settled, joint: int) -> tuple[Real, Real] | None:
    """(K,) error of the joint at each reading and its variance, rad and rad^2; None where it has none."""
    s = found.mixture.situation
    target = TARGETS[joint - 1]
    basis = np.zeros((len(s), len(settled.x)))
    for family, choice, part in zip(settled.families, settled.choices, settled.parts, strict=True):
        if family.named or family.depends_on != target:
            continue
        hidden = family.hidden[choice.member : choice.member + 1]
        for action in family.actions(s, hidden):
            if action.target == target:
                basis[:, part] += action.basis[0]
    if not basis.any():
        return None
    return basis @ settled.x, np.einsum("kx,kx->k", basis @ settled.covariance, basis)
