"""`/calibrations/{id}/diagnosis` and `/report.html`: causes that a run found, for programs and people."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter
from fastapi.responses import HTMLResponse

from station.diagnosis.page import page
from station.diagnostic_run import diagnosed
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
