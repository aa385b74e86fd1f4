"""The catalogue of effects: one small module per effect.

A new effect is one new file and one line in the catalogue of each machine that can have it.
"""

from __future__ import annotations

from station.effects.base import (
    Acts,
    Effect,
    JointEffect,
    Variants,
    amplitude_and_phase,
    doubtful,
    signature,
    weight,
)
from station.effects.catalogue import arm_catalogue, five_bar_catalogue
from station.effects.cyclic import OVERSAMPLING, waves
from station.effects.gear_curve import GearCurve, curve_basis, fast_basis

__all__ = [
    "OVERSAMPLING",
    "Acts",
    "Effect",
    "GearCurve",
    "JointEffect",
    "Variants",
    "amplitude_and_phase",
    "arm_catalogue",
    "curve_basis",
    "doubtful",
    "fast_basis",
    "five_bar_catalogue",
    "signature",
    "waves",
    "weight",
]
