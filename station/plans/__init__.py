"""Measurement plans: the positions, their order, and the predicted accuracy.

Each plan is a module that registers itself. Importing the package registers all plans.
"""

from __future__ import annotations

# they register themselves, in the order in which they are offered
from station.plans import boundary, full, diagnostic_sequence, foreseen, check_positions, guided  # isort: skip  # noqa: F401
from station.plans.check_positions import REST_P, SHIFT_P, ShiftTest
from station.plans.diagnostic_sequence import FRESH_PLACES, SIDES, diagnostic_fresh_stops
from station.plans.drawing import STOP_COLUMNS, plan_as_text, plan_page, stop_rows
from station.plans.duration import USUAL, Pace
from station.plans.full import candidates, full_positions, inset_grid
from station.plans.next_position import Contradiction, changes_of, gains, with_readings
from station.plans.plan import PLANS, RECOMMENDED, PlanDesign, Visits, each_once, make_plan, register
from station.plans.prediction import predict, zeros_only
from station.plans.quickest import Quickest

__all__ = [
    "FRESH_PLACES",
    "PLANS",
    "RECOMMENDED",
    "REST_P",
    "SHIFT_P",
    "SIDES",
    "STOP_COLUMNS",
    "USUAL",
    "Contradiction",
    "Pace",
    "PlanDesign",
    "Quickest",
    "ShiftTest",
    "Visits",
    "candidates",
    "changes_of",
    "diagnostic_fresh_stops",
    "each_once",
    "full_positions",
    "gains",
    "inset_grid",
    "make_plan",
    "plan_as_text",
    "plan_page",
    "predict",
    "register",
    "stop_rows",
    "with_readings",
    "zeros_only",
]
