"""Moving the machine: devices, limits, measuring at a stop, writing zeros, standstill."""

from __future__ import annotations

from station.motion.devices import Devices, build_devices
from station.motion.emulated_rig import EffectTable, EmulatedRig
from station.motion.emulated_rig import FaultOrder as FaultOrder
from station.motion.events import Listener, Listeners, LiveEvent
from station.motion.machine import Machine
from station.motion.positioner import Cancelled, Positioner
from station.motion.retracting import Retracting
from station.motion.zero_writer import Zeroing, shift_of

__all__ = [
    "Cancelled",
    "Devices",
    "EffectTable",
    "EmulatedRig",
    "FaultOrder",
    "Listener",
    "Listeners",
    "LiveEvent",
    "Machine",
    "Positioner",
    "Retracting",
    "Zeroing",
    "build_devices",
    "shift_of",
]
