"""The interface of a machine for identification and diagnosis, and the conditions of its readings."""

from __future__ import annotations

from station.mechanism.conditions import (
    Conditions,
    Reference,
    last_motion,
    last_way,
    net_travel,
    readings_before,
    reference_of,
    temperature_rise,
)
from station.mechanism.observation import Observation, Parameter
from station.mechanism.protocol import Mechanism, axes, axis_of_row, by_reading
from station.mechanism.run_up import STILL_DEG, last_senses, needs_run_up

__all__ = [
    "STILL_DEG",
    "Conditions",
    "Mechanism",
    "Observation",
    "Parameter",
    "Reference",
    "axes",
    "axis_of_row",
    "by_reading",
    "last_motion",
    "last_senses",
    "last_way",
    "needs_run_up",
    "net_travel",
    "readings_before",
    "reference_of",
    "temperature_rise",
]
