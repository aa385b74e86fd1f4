"""The closed loop: residual, cause, model, confirmation."""

from __future__ import annotations

from station.diagnosis.closed_loop import Diagnosis, diagnose
from station.diagnosis.decision import Decision, StageFigures, decide
from station.diagnosis.explanations import ExplanationSet, explain
from station.diagnosis.learned import (
    Transfer,
    commands_csv,
    learned_model,
    model_document,
    range_text,
    read_model,
    read_part,
    read_targets,
    solve_targets,
    targets_of,
    transfer,
)
from station.diagnosis.mistakes import Context, Mistake, find_mistake, fit_readings
from station.diagnosis.report import (
    Curve,
    Findings,
    curve_chart,
    curves,
    kept_fresh,
    page,
    residuals,
    shown,
)
from station.diagnosis.search import Scan
from station.diagnosis.separating import Experiment, experiment
from station.diagnosis.tests_of_fit import without_a_quarter

__all__ = [
    "Context",
    "Curve",
    "Decision",
    "Diagnosis",
    "Experiment",
    "ExplanationSet",
    "Findings",
    "Mistake",
    "Scan",
    "StageFigures",
    "Transfer",
    "commands_csv",
    "curve_chart",
    "curves",
    "decide",
    "diagnose",
    "experiment",
    "explain",
    "find_mistake",
    "fit_readings",
    "kept_fresh",
    "learned_model",
    "model_document",
    "page",
    "range_text",
    "read_model",
    "read_part",
    "read_targets",
    "residuals",
    "shown",
    "solve_targets",
    "targets_of",
    "transfer",
    "without_a_quarter",
]
