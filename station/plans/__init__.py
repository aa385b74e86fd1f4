"""Measurement plans: which positions, in which order, and the accuracy that they predict."""

from __future__ import annotations

from station.plans.diagnostic_sequence import FRESH_PLACES, SIDES, diagnostic_fresh_stops
from station.plans.drawing import plan_as_text, plan_page
from station.plans.plans import make_plan, predict

__all__ = [
    "FRESH_PLACES",
    "SIDES",
    "diagnostic_fresh_stops",
    "make_plan",
    "plan_as_text",
    "plan_page",
    "predict",
]
