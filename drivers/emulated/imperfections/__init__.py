"""The imperfections an emulated machine can have, one a module, each acting where it acts in reality."""

from typing import Annotated

from pydantic import Field

from drivers.emulated.imperfections.backlash import Backlash
from drivers.emulated.imperfections.base import Effect
from drivers.emulated.imperfections.cable_drag import CableDrag
from drivers.emulated.imperfections.compliance import Compliance
from drivers.emulated.imperfections.count_slip import CountSlip
from drivers.emulated.imperfections.drift import Drift
from drivers.emulated.imperfections.encoder_eccentricity import EncoderEccentricity
from drivers.emulated.imperfections.field_bump import FieldBump
from drivers.emulated.imperfections.gear_cyclic import GearCyclic
from drivers.emulated.imperfections.joint_clearance import JointClearance
from drivers.emulated.imperfections.link_length import LinkLength
from drivers.emulated.imperfections.outliers import Outliers
from drivers.emulated.imperfections.random_walk import RandomWalk
from drivers.emulated.imperfections.scale_bow import ScaleBow
from drivers.emulated.imperfections.scale_cyclic import ScaleCyclic
from drivers.emulated.imperfections.scale_gain import ScaleGain
from drivers.emulated.imperfections.scale_hysteresis import ScaleHysteresis
from drivers.emulated.imperfections.slider_drag import SliderDrag
from drivers.emulated.imperfections.sticky_patch import StickyPatch
from drivers.emulated.imperfections.stiction_patch import StictionPatch
from drivers.emulated.imperfections.thermal_growth import ThermalGrowth
from drivers.emulated.imperfections.transmission_gain import TransmissionGain
from drivers.emulated.imperfections.wandering_zero import WanderingZero

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
