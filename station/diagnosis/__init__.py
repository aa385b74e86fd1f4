"""The closed loop: residual, cause, model, confirmation."""

from __future__ import annotations

from station.diagnosis.closed_loop import AnyDiagnosis, diagnose
from station.diagnosis.decision import Decision, StageFigures, decide
from station.diagnosis.experiments import Trial, trials
from station.diagnosis.explanations import Around, ExplanationSet, explain
from station.diagnosis.learned import (
    TargetRefused,
    Transfer,
    commands_csv,
    learned_model,
    model_document,
    range_said,
    read_model,
    read_part,
    read_targets,
    solve_targets,
    targets_of,
    transfer,
)
from station.diagnosis.mistakes import Context, Mistake, MistakeRefused, find_mistake, fit_readings
from station.diagnosis.report import (
    Curve,
    Findings,
    TracedFindings,
    WeighedFindings,
    curve_chart,
    curves,
    findings_of,
    kept_fresh,
    page,
    residuals,
    run_source,
    shown,
    stage_name,
)
from station.diagnosis.search import Scan
from station.diagnosis.separating import Experiment, experiment
from station.diagnosis.tests_of_fit import without_a_quarter
from station.diagnosis.traced_loop import TracedDiagnosis, traced
from station.diagnosis.weighed_loop import WeighedDiagnosis, weighed

__all__ = [
    "AnyDiagnosis",
    "Around",
    "Context",
    "Curve",
    "Decision",
    "Experiment",
    "ExplanationSet",
    "Findings",
    "Mistake",
    "MistakeRefused",
    "Scan",
    "StageFigures",
    "TargetRefused",
    "TracedDiagnosis",
    "TracedFindings",
    "Transfer",
    "Trial",
    "WeighedDiagnosis",
    "WeighedFindings",
    "commands_csv",
    "curve_chart",
    "curves",
    "decide",
    "diagnose",
    "experiment",
    "explain",
    "find_mistake",
    "findings_of",
    "fit_readings",
    "kept_fresh",
    "learned_model",
    "model_document",
    "page",
    "range_said",
    "read_model",
    "read_part",
    "read_targets",
    "residuals",
    "run_source",
    "shown",
    "solve_targets",
    "stage_name",
    "targets_of",
    "traced",
    "transfer",
    "trials",
    "weighed",
    "without_a_quarter",
]
