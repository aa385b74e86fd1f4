"""Moving the machine: devices, limits, measuring at a stop, writing zeros, standstill."""

from __future__ import annotations

from station.motion.clock import Clock, PlayedClock, RunClock
from station.motion.devices import Devices, build_devices
from station.motion.emulated_rig import EffectTable, EmulatedRig
from station.motion.emulated_rig import FaultOrder as FaultOrder
from station.motion.events import Listener, Listeners, LiveEvent
from station.motion.interlocks import Interlocks, Tripped
from station.motion.machine import Machine
from station.motion.opening import Equipment, equipment
from station.motion.positioner import Cancelled, Positioner
from station.motion.retracting import Retracting
from station.motion.way_back import outside_mm
from station.motion.wire_exchanges import exchanges
from station.motion.wire_words import in_words
from station.motion.zero_writer import Zeroing, shift_of

__all__ = [
    "Cancelled",
    "Clock",
    "Devices",
    "EffectTable",
    "EmulatedRig",
    "Equipment",
    "FaultOrder",
    "Interlocks",
    "Listener",
    "Listeners",
    "LiveEvent",
    "Machine",
    "PlayedClock",
    "Positioner",
    "Retracting",
    "RunClock",
    "Tripped",
    "Zeroing",
    "build_devices",
    "equipment",
    "exchanges",
    "in_words",
    "outside_mm",
    "shift_of",
]
