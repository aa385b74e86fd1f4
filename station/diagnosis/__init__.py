"""The closed loop: residual, cause, model, confirmation (method.md section 3)."""

from __future__ import annotations

from station.diagnosis.closed_loop import Diagnosis, diagnose
from station.diagnosis.learned import (
    ModelPart,
    Transfer,
    commands_csv,
    model_json,
    model_of,
    range_text,
    read_model,
    read_part,
    read_targets,
    solve_targets,
    targets_of,
    transfer,
)
from station.diagnosis.report import (
    Curve,
    Findings,
    StageErrors,
    curve_chart,
    curves,
    extent,
    kept_fresh,
    page,
    residuals,
    shown,
)
from station.diagnosis.search import Scan
from station.diagnosis.separating import Experiment, experiment
from station.diagnosis.tests_of_fit import without_a_quarter

__all__ = [
    "Curve",
    "Diagnosis",
    "Experiment",
    "Findings",
    "ModelPart",
    "Scan",
    "StageErrors",
    "Transfer",
    "commands_csv",
    "curve_chart",
    "curves",
    "diagnose",
    "experiment",
    "extent",
    "kept_fresh",
    "model_json",
    "model_of",
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
