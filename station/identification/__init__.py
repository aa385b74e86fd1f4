"""Zero offsets and geometry identified from readings, verified by fresh ones, remembered for the next run."""

from __future__ import annotations

from station.identification.arm import ArmIdentification, identify_arm
from station.identification.five_bar import Identification, identify, memory_of
from station.identification.memory import FORGOTTEN, GATE_P, Memory, contradiction_p
from station.identification.verification import (
    LIMIT_SDS,
    Verification,
    fresh_stops,
    not_identified,
    prediction_fault,
    result_of,
    verify,
    weak_direction_of,
    with_best_remedy,
)
from station.identification.weak_direction import describe_weak_direction

__all__ = [
    "FORGOTTEN",
    "GATE_P",
    "LIMIT_SDS",
    "ArmIdentification",
    "Identification",
    "Memory",
    "Verification",
    "contradiction_p",
    "describe_weak_direction",
    "fresh_stops",
    "identify",
    "identify_arm",
    "memory_of",
    "not_identified",
    "prediction_fault",
    "result_of",
    "verify",
    "weak_direction_of",
    "with_best_remedy",
]
