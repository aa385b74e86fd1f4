"""The effects of each kind of machine, at every place where they can act."""

from __future__ import annotations

from collections.abc import Sequence

from station.effects.backlash import Backlash
from station.effects.base import Effect
from station.effects.compliance import Compliance
from station.effects.count_slip import CountSlip
from station.effects.cyclic import EncoderEccentricity, GearCyclic
from station.effects.gear_curve import GearCurve
from station.effects.lag import Delay, JointLag, Lag
from station.effects.lengths import JointClearance, LinkLength
from station.effects.scale import ScaleBow, ScaleCyclic, ScaleGain, ScaleHysteresis
from station.effects.time import Drift, ThermalGrowth, ThermalLinks
from station.effects.transmission_gain import TransmissionGain

PER_JOINT = (Backlash, GearCyclic, EncoderEccentricity, TransmissionGain, Compliance, CountSlip)


def five_bar_catalogue() -> tuple[Effect, ...]:
    """All effects at every place of action of a five-bar with its scale."""
    numbers = (1, 2)
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


def arm_catalogue(
    joints: int, *, by_range: bool, timed: bool = True, warmed: bool = True, sliding: Sequence[int] = ()
) -> tuple[Effect, ...]:
    """All effects at every joint of a serial arm; with distances also those of the instrument.

    timed: the log contains the time of each reading; warmed: it contains temperatures. sliding: joints that
    slide; effects in degrees do not apply to them.
    """
    at_joints = tuple(
        CountSlip(joint, timed=timed) if effect is CountSlip else effect(joint)
        for effect in (*PER_JOINT, GearCurve, JointLag)
        for joint in range(1, joints + 1)
        if joint not in sliding or effect in (TransmissionGain, JointLag)
    )
    growth = (ThermalLinks(), *((ThermalGrowth(),) if by_range else ())) if timed or warmed else ()
    drift = (Drift(),) if timed and by_range else ()
    return (*at_joints, Lag(), Delay(timed=timed), *growth, *((ScaleGain(),) if by_range else ()), *drift)
