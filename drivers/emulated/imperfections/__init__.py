"""The imperfections of an emulated machine, one per module, each acting where it acts in reality.

A diagnosis has a catalogue of causes; the kinds below were written by a person who had not read it, and are
outside it. The last two columns are for the default size over the 120 stops of the plan `full`: root mean
square of the change of the readings about their mean, and of the residual after a fit of zero offsets,
geometry within its tolerance and the mechanism's error.

==================== =============== ================================ ======= ======= kind
rough or smooth size (default)                    raw um  left um ==================== ===============
================================ ======= ======= arm_coupling         smooth          deg_at_horizontal =
0.016            10     0.7 axis_tilt            smooth          tilt_deg = 1.3                       11
0.5 base_flex            smooth          sideways_mm = 0.15                   11     0.4 bearing_runout
smooth          amplitude_mm = 0.04, waves = 2       10     0.5 belt_stretch         smooth
deg_at_horizontal = 0.015             8     0.9 cable_torque         smooth          deg_at_end = 0.012
10     0.9 cable_windup         smooth          deg_at_end = 0.02                     8     0.5
encoder_ellipse      smooth          amplitude_deg = 0.004, waves = 2      9     0.3 guide_sag
smooth          mm_at_corner = 0.02                  10     0.7 link_bend            smooth
mm_at_horizontal = 0.3                9     0.5 platform_tilt        smooth          deg_at_reach = 0.16
10     0.3 platform_yaw         smooth          share = 0.006                        10     0.1 stiffening_sag
smooth          deg_at_horizontal = 0.03             11     0.2 base_gradient        smooth in time  out_mm =
0.06, up_mm = 0.02           9     7 sinking_bearing      smooth in time  mm_per_min = 0.07
10    10 mounting_creep       smooth in time  mm_per_decade = 0.033                10    10 room_cycle
smooth in time  amplitude_mm = 0.014                 10    10 base_ringing         rough
mm_at_100_deg_per_s = 0.09           10     7 healing_step         rough           step_mm = 0.02
9     9 interpolation_error  rough           amplitude_mm = 0.013                  9     7 loose_head
rough           sd_mm = 0.01                         10    10 slipping_link        rough           mm = 0.04
11    10 loose_elbow          rough           mm = 0.017                           10     8 magnetised_spot
rough           peak_mm = 0.025                      11     6 readout_lag          rough           share =
0.00015                      10     7 reading_step         rough           step_mm = 0.02
10    10 rest_by_distance     rough           deg = 0.0035                         10     7 reversal_slip
rough           deg_up = 0.003, deg_down = 0.0028     9     8 speed_stiction       rough           deg =
0.0065                         10     8 worn_sector          rough           deg = 0.008
11     2 ==================== =============== ================================ ======= =======

Outside as well, without defaults: cable_drag, field_bump, random_walk, slider_drag, sticky_patch,
stiction_patch, wandering_zero; a distal link far off is `link_length` with some millimetres.
"""

from typing import Annotated

from pydantic import Field

from drivers.emulated.imperfections.arm_coupling import ArmCoupling
from drivers.emulated.imperfections.axis_tilt import AxisTilt
from drivers.emulated.imperfections.backlash import Backlash
from drivers.emulated.imperfections.base import Effect
from drivers.emulated.imperfections.base_flex import BaseFlex
from drivers.emulated.imperfections.base_gradient import BaseGradient
from drivers.emulated.imperfections.base_ringing import BaseRinging
from drivers.emulated.imperfections.bearing_runout import BearingRunout
from drivers.emulated.imperfections.belt_stretch import BeltStretch
from drivers.emulated.imperfections.cable_drag import CableDrag
from drivers.emulated.imperfections.cable_torque import CableTorque
from drivers.emulated.imperfections.cable_windup import CableWindup
from drivers.emulated.imperfections.compliance import Compliance
from drivers.emulated.imperfections.count_slip import CountSlip
from drivers.emulated.imperfections.drift import Drift
from drivers.emulated.imperfections.encoder_eccentricity import EncoderEccentricity
from drivers.emulated.imperfections.encoder_ellipse import EncoderEllipse
from drivers.emulated.imperfections.field_bump import FieldBump
from drivers.emulated.imperfections.gear_cyclic import GearCyclic
from drivers.emulated.imperfections.guide_sag import GuideSag
from drivers.emulated.imperfections.healing_step import HealingStep
from drivers.emulated.imperfections.interpolation_error import InterpolationError
from drivers.emulated.imperfections.joint_clearance import JointClearance
from drivers.emulated.imperfections.link_bend import LinkBend
from drivers.emulated.imperfections.link_length import LinkLength
from drivers.emulated.imperfections.loose_elbow import LooseElbow
from drivers.emulated.imperfections.loose_head import LooseHead
from drivers.emulated.imperfections.magnetised_spot import MagnetisedSpot
from drivers.emulated.imperfections.mounting_creep import MountingCreep
from drivers.emulated.imperfections.outliers import Outliers
from drivers.emulated.imperfections.platform_tilt import PlatformTilt
from drivers.emulated.imperfections.platform_yaw import PlatformYaw
from drivers.emulated.imperfections.random_walk import RandomWalk
from drivers.emulated.imperfections.reading_step import ReadingStep
from drivers.emulated.imperfections.readout_lag import ReadoutLag
from drivers.emulated.imperfections.rest_by_distance import RestByDistance
from drivers.emulated.imperfections.reversal_slip import ReversalSlip
from drivers.emulated.imperfections.room_cycle import RoomCycle
from drivers.emulated.imperfections.scale_bow import ScaleBow
from drivers.emulated.imperfections.scale_cyclic import ScaleCyclic
from drivers.emulated.imperfections.scale_gain import ScaleGain
from drivers.emulated.imperfections.scale_hysteresis import ScaleHysteresis
from drivers.emulated.imperfections.sinking_bearing import SinkingBearing
from drivers.emulated.imperfections.slider_drag import SliderDrag
from drivers.emulated.imperfections.slipping_link import SlippingLink
from drivers.emulated.imperfections.speed_stiction import SpeedStiction
from drivers.emulated.imperfections.sticky_patch import StickyPatch
from drivers.emulated.imperfections.stiction_patch import StictionPatch
from drivers.emulated.imperfections.stiffening_sag import StiffeningSag
from drivers.emulated.imperfections.thermal_growth import ThermalGrowth
from drivers.emulated.imperfections.transmission_gain import TransmissionGain
from drivers.emulated.imperfections.wandering_zero import WanderingZero
from drivers.emulated.imperfections.worn_sector import WornSector

AnyEffect = Annotated[
    ArmCoupling
    | AxisTilt
    | Backlash
    | BaseFlex
    | BaseGradient
    | BaseRinging
    | BearingRunout
    | BeltStretch
    | CableDrag
    | CableTorque
    | CableWindup
    | Compliance
    | CountSlip
    | Drift
    | EncoderEccentricity
    | EncoderEllipse
    | FieldBump
    | GearCyclic
    | GuideSag
    | HealingStep
    | InterpolationError
    | JointClearance
    | LinkBend
    | LinkLength
    | LooseElbow
    | LooseHead
    | MagnetisedSpot
    | MountingCreep
    | Outliers
    | PlatformTilt
    | PlatformYaw
    | RandomWalk
    | ReadingStep
    | ReadoutLag
    | RestByDistance
    | ReversalSlip
    | RoomCycle
    | ScaleBow
    | ScaleCyclic
    | ScaleGain
    | ScaleHysteresis
    | SinkingBearing
    | SliderDrag
    | SlippingLink
    | SpeedStiction
    | StickyPatch
    | StictionPatch
    | StiffeningSag
    | ThermalGrowth
    | TransmissionGain
    | WanderingZero
    | WornSector,
    Field(discriminator="kind"),
]

__all__ = [
    "AnyEffect",
    "ArmCoupling",
    "AxisTilt",
    "Backlash",
    "BaseFlex",
    "BaseGradient",
    "BaseRinging",
    "BearingRunout",
    "BeltStretch",
    "CableDrag",
    "CableTorque",
    "CableWindup",
    "Compliance",
    "CountSlip",
    "Drift",
    "Effect",
    "EncoderEccentricity",
    "EncoderEllipse",
    "FieldBump",
    "GearCyclic",
    "GuideSag",
    "HealingStep",
    "InterpolationError",
    "JointClearance",
    "LinkBend",
    "LinkLength",
    "LooseElbow",
    "LooseHead",
    "MagnetisedSpot",
    "MountingCreep",
    "Outliers",
    "PlatformTilt",
    "PlatformYaw",
    "RandomWalk",
    "ReadingStep",
    "ReadoutLag",
    "RestByDistance",
    "ReversalSlip",
    "RoomCycle",
    "ScaleBow",
    "ScaleCyclic",
    "ScaleGain",
    "ScaleHysteresis",
    "SinkingBearing",
    "SliderDrag",
    "SlippingLink",
    "SpeedStiction",
    "StickyPatch",
    "StictionPatch",
    "StiffeningSag",
    "ThermalGrowth",
    "TransmissionGain",
    "WanderingZero",
    "WornSector",
]
