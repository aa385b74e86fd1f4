"""`/calibrations/{id}/diagnosis`, `/report.html` and `/solve`: the causes that a run found, and their use."""

from __future__ import annotations

from typing import Any

import numpy as np
from fastapi import APIRouter
from fastapi.responses import HTMLResponse

from station.diagnosis.model_file import model_of
from station.diagnosis.page import page
from station.diagnosis.solve import range_text, solve_targets
from station.diagnosis.targets import targets_of
from station.diagnostic_run import diagnosed
from web.bodies import JointCommand, Solution, SolveBody
from web.problems import documented
from web.routes.parts import CalibrationId, TheRuntime

REPORT_POLICY = (
    "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)
"""The report needs nothing but the styles in itself, so that it can be saved and mailed."""

router = APIRouter(prefix="/calibrations/{calibration_id}", tags=["diagnosis"])


@router.get("/diagnosis", responses=documented(404))
def read_diagnosis(calibration_id: CalibrationId, runtime: TheRuntime) -> dict[str, Any]:
    """The whole document, schema `station.diagnosis/1`, as `station diagnose --json` writes it."""
    return runtime.store.diagnosis(calibration_id)


@router.get("/report.html", response_class=HTMLResponse, responses=documented(404))
def read_report(calibration_id: CalibrationId, runtime: TheRuntime) -> HTMLResponse:
    """The diagnosis as a page with drawings, computed again from the stored readings."""
    store = runtime.store
    store.diagnosis(calibration_id)
    robot = store.robot_of(calibration_id)
    report = page(
        diagnosed(robot, store.readings(calibration_id)), f"run {calibration_id}, robot {robot.serial}"
    )
    return HTMLResponse(report.to_html(), headers={"Content-Security-Policy": REPORT_POLICY})


@router.post("/solve", response_model=Solution, responses=documented(404))
def solve(calibration_id: CalibrationId, body: SolveBody, runtime: TheRuntime) -> Solution:
    """Joint commands that bring P to the targets under the run's model, with every effect on the position.

    Refused are targets out of reach or beyond what an effect was learned on, and those without the
    approach, temperature or payload that an effect needs; the problem names target and field.
    """
    model = model_of(runtime.store.diagnosis(calibration_id), f"of run {calibration_id}")
    theta_deg = np.degrees(solve_targets(model, targets_of([t.model_dump() for t in body.targets])))
    return Solution(
        commands=[JointCommand(theta1_deg=float(a), theta2_deg=float(b)) for a, b in theta_deg],
        range=range_text(model),
        confirmed=model.confirmed,
    )
