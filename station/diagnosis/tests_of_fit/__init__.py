"""Tests of a fit: adequacy, smooth departures, unnamed alternatives, confirmation, cross-validation."""

from __future__ import annotations

from station.diagnosis.tests_of_fit.adequacy import ALPHA, Adequacy, judge
from station.diagnosis.tests_of_fit.alternatives import strongest
from station.diagnosis.tests_of_fit.confirmation import FEWEST, Confirmation, confirm
from station.diagnosis.tests_of_fit.cross_validation import (
    folds,
    left_out_rms,
    left_without,
    predicted_by_others,
    without_a_quarter,
    without_neighbours,
)
from station.diagnosis.tests_of_fit.smooth_departures import (
    Departure,
    WhitenedResidual,
    added,
    by_approach_and_place,
    by_searched,
    departures,
    half_waves,
    in_doubt,
    of_fit,
    perpendicular,
    senses,
    turned,
    whitened_residual,
)

__all__ = [
    "ALPHA",
    "FEWEST",
    "Adequacy",
    "Confirmation",
    "Departure",
    "WhitenedResidual",
    "added",
    "by_approach_and_place",
    "by_searched",
    "confirm",
    "departures",
    "folds",
    "half_waves",
    "in_doubt",
    "judge",
    "left_out_rms",
    "left_without",
    "of_fit",
    "perpendicular",
    "predicted_by_others",
    "senses",
    "strongest",
    "turned",
    "whitened_residual",
    "without_a_quarter",
    "without_neighbours",
]
