"""The catalogue: one small unit an effect (method.md section 3).

Adding an effect is one new file and one line in `catalogue`.
"""

from __future__ import annotations

from station.effects.backlash import Backlash
from station.effects.base import Acts, Conditions, Effect, Variants, doubtful, signature
from station.effects.compliance import Compliance
from station.effects.count_slip import CountSlip
from station.effects.cyclic import EncoderEccentricity, GearCyclic
from station.effects.lengths import JointClearance, LinkLength
from station.effects.scale import ScaleBow, ScaleCyclic, ScaleGain, ScaleHysteresis
from station.effects.time import Drift, ThermalGrowth, ThermalLinks
from station.effects.transmission_gain import TransmissionGain

__all__ = ["Acts", "Conditions", "Effect", "Variants", "catalogue", "doubtful", "signature"]

PER_JOINT = (Backlash, GearCyclic, EncoderEccentricity, TransmissionGain, Compliance, CountSlip)


def catalogue(joints: int = 2) -> tuple[Effect, ...]:
    """Every effect at every place of a five-bar with its scale."""
    numbers = range(1, joints + 1)
    return (
        *(effect(joint) for effect in PER_JOINT for joint in numbers),
        *(LinkLength(joint, f"{kind}{joint}") for kind in "Ll" for joint in numbers),
        *(JointClearance(joint) for joint in numbers),
        ScaleGain(),
        ScaleBow(),
        ScaleCyclic(),
        ScaleHysteresis(),
        Drift(),
        ThermalGrowth(),
        ThermalLinks(),
    )
