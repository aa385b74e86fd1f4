"""Zero offsets and geometry identified from readings, verified by fresh ones, and stored for the next run."""

from __future__ import annotations

from station.identification.advice import advice_of
from station.identification.bound import PLAN_ENDED, accuracy_of, bounds_mm, expected_bound_mm, with_accuracy
from station.identification.document import gate_record, identification_document, position_error_map
from station.identification.error_map import error_fields, fresh_readings
from station.identification.estimate import Gate, Identification, identify
from station.identification.fleet import fleet_prior
from station.identification.jump import without_jump
from station.identification.memory import GATE_P, Memory
from station.identification.same_geometry import zero_difference
from station.identification.sequential import Innovation, Known
from station.identification.verification import (
    Verification,
    fresh_stops,
    fresh_stops_of,
    not_identified,
    predicted_result,
    prediction_fault,
    residuals_of,
    result_of,
    verify,
)

__all__ = [
    "GATE_P",
    "PLAN_ENDED",
    "Gate",
    "Identification",
    "Innovation",
    "Known",
    "Memory",
    "Verification",
    "accuracy_of",
    "advice_of",
    "bounds_mm",
    "error_fields",
    "expected_bound_mm",
    "fleet_prior",
    "fresh_readings",
    "fresh_stops",
    "fresh_stops_of",
    "gate_record",
    "identification_document",
    "identify",
    "not_identified",
    "position_error_map",
    "predicted_result",
    "prediction_fault",
    "residuals_of",
    "result_of",
    "verify",
    "with_accuracy",
    "without_jump",
    "zero_difference",
]
