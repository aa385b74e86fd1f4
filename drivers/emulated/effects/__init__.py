"""The imperfections an emulated machine can have, one a module, each acting where it acts in reality."""

from typing import Annotated

from pydantic import Field

from drivers.emulated.effects.backlash import Backlash
from drivers.emulated.effects.base import Effect
from drivers.emulated.effects.cable_drag import CableDrag
from drivers.emulated.effects.compliance import Compliance
from drivers.emulated.effects.count_slip import CountSlip
from drivers.emulated.effects.drift import Drift
from drivers.emulated.effects.encoder_eccentricity import EncoderEccentricity
from drivers.emulated.effects.field_bump import FieldBump
from drivers.emulated.effects.gear_cyclic import GearCyclic
from drivers.emulated.effects.joint_clearance import JointClearance
from drivers.emulated.effects.link_length import LinkLength
from drivers.emulated.effects.outliers import Outliers
from drivers.emulated.effects.random_walk import RandomWalk
from drivers.emulated.effects.scale_bow import ScaleBow
from drivers.emulated.effects.scale_cyclic import ScaleCyclic
from drivers.emulated.effects.scale_gain import ScaleGain
from drivers.emulated.effects.scale_hysteresis import ScaleHysteresis
from drivers.emulated.effects.slider_drag import SliderDrag
from drivers.emulated.effects.sticky_patch import StickyPatch
from drivers.emulated.effects.stiction_patch import StictionPatch
from drivers.emulated.effects.thermal_growth import ThermalGrowth
from drivers.emulated.effects.transmission_gain import TransmissionGain
from drivers.emulated.effects.wandering_zero import WanderingZero

AnyEffect = Annotated[
    Backlash
    | CableDrag
    | Compliance
    | CountSlip
    | Drift
    | EncoderEccentricity
    | FieldBump
    | GearCyclic
    | JointClearance
    | LinkLength
    | Outliers
    | RandomWalk
    | ScaleBow
    | ScaleCyclic
    | ScaleGain
    | ScaleHysteresis
    | SliderDrag
    | StickyPatch
    | StictionPatch
    | ThermalGrowth
    | TransmissionGain
    | WanderingZero,
    Field(discriminator="kind"),
]

__all__ = [
    "AnyEffect",
    "Backlash",
    "CableDrag",
    "Compliance",
    "CountSlip",
    "Drift",
    "Effect",
    "EncoderEccentricity",
    "FieldBump",
    "GearCyclic",
    "JointClearance",
    "LinkLength",
    "Outliers",
    "RandomWalk",
    "ScaleBow",
    "ScaleCyclic",
    "ScaleGain",
    "ScaleHysteresis",
    "SliderDrag",
    "StickyPatch",
    "StictionPatch",
    "ThermalGrowth",
    "TransmissionGain",
    "WanderingZero",
]
