"""Results of a run, under `/calibrations/{id}`: diagnosis, residuals, report, separating motion, solve."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
from fastapi.responses import HTMLResponse

from station.diagnosis import (
    Findings,
    learned_model,
    page,
    range_said,
    residuals,
    run_source,
    solve_targets,
    targets_of,
)
from station.errors import NotApplicable
from station.people import Permission
from station.records import DiagnosisDocument, Reading
from station.run_kinds import check_not_locked, diagnosed, planned
from station.service import Runtime
from web.bodies import (
    JointCommand,
    ResidualList,
    ResidualRow,
    Separating,
    SeparatingStop,
    Solution,
    SolveBody,
)
from web.guarded import Router, needs
from web.headers import SELF_CONTAINED
from web.problems import documented
from web.routes.parts import CalibrationId, InLanguage, TheRuntime

REPORT_POLICY = f"{SELF_CONTAINED}; frame-ancestors 'none'"

router = Router(prefix="/calibrations/{calibration_id}", tags=["diagnosis"])


@router.get(
    "/diagnosis",
    response_model=DiagnosisDocument,
    responses=documented(404),
    dependencies=[needs(Permission.READ)],
)
def read_diagnosis(calibration_id: CalibrationId, runtime: TheRuntime) -> DiagnosisDocument:
    """The whole document, schema `station.diagnosis/2`, as `station diagnose --json` writes it."""
    return runtime.store.diagnosis(calibration_id)


@router.get(
    "/residuals",
    response_model=ResidualList,
    responses=documented(404),
    dependencies=[needs(Permission.READ)],
)
def read_residuals(calibration_id: CalibrationId, runtime: TheRuntime) -> ResidualList:
    """The residual of every reading without and with the effects, computed again from the stored readings."""
    if (kept := runtime.store.log_documents(calibration_id)) is not None:
        return ResidualList.model_validate_json(kept.residuals)
    findings, readings = _again(runtime, calibration_id)
    found = residuals(findings, {r.reading: r.position for r in readings})
    return ResidualList(
        effects=list(found.effects), items=[ResidualRow.model_validate(asdict(row)) for row in found.rows]
    )


@router.get(
    "/separating", response_model=Separating, responses=documented(404), dependencies=[needs(Permission.READ)]
)
def read_separating(calibration_id: CalibrationId, runtime: TheRuntime) -> Separating:
    """The motion that distinguishes the cause from its alternatives, or why there is none.

    `POST .../separate` runs it.
    """
    try:
        plan = planned(runtime.store, calibration_id)
    except NotApplicable as none:
        return Separating(apart=[], stops=[], duration_s=None, refused=str(none))
    stops = [
        SeparatingStop(position=s.position, x_mm=s.target_mm[0], y_mm=s.target_mm[1])
        for s in plan.experiment.stops
    ]
    return Separating(
        apart=list(plan.experiment.apart), stops=stops, duration_s=plan.duration_s, refused=None
    )


@router.get(
    "/report.html",
    response_class=HTMLResponse,
    responses=documented(404),
    dependencies=[needs(Permission.READ)],
)
def read_report(
    calibration_id: CalibrationId, runtime: TheRuntime, language: InLanguage = "en"
) -> HTMLResponse:
    """The diagnosis as a page with drawings, computed again from the stored readings.

    The report of an arm's log was stored when the log was imported, in English.
    """
    headers = {"Content-Security-Policy": REPORT_POLICY}
    if (kept := runtime.store.log_documents(calibration_id)) is not None:
        return HTMLResponse(kept.report, headers=headers)
    findings, _ = _again(runtime, calibration_id)
    uid = runtime.store.summary(calibration_id).uid
    source = run_source(calibration_id, uid, findings.robot.serial, language)
    report = page(findings, source, language)
    return HTMLResponse(report.to_html(), headers=headers)


@router.post(
    "/solve", response_model=Solution, responses=documented(404, 409), dependencies=[needs(Permission.READ)]
)
def solve(calibration_id: CalibrationId, body: SolveBody, runtime: TheRuntime) -> Solution:
    """Joint commands that bring P to the targets under the run's model, with every effect on the position.

    Targets are refused if they are out of reach or outside the learned range of an effect, or without the
    approach, temperature or payload that an effect needs; the problem names target and field.
    """
    check_not_locked(runtime.store, calibration_id)
    model = learned_model(runtime.store.diagnosis(calibration_id).model, f"of run {calibration_id}")
    theta_deg = np.degrees(solve_targets(model, targets_of([t.model_dump() for t in body.targets])))
    learned_on = range_said(model)
    return Solution(
        commands=[JointCommand(theta1_deg=float(a), theta2_deg=float(b)) for a, b in theta_deg],
        range=learned_on.text(),
        range_said=learned_on,
        confirmed=model.confirmed,
    )


def _again(runtime: Runtime, calibration_id: int) -> tuple[Findings, list[Reading]]:
    """The diagnosis of a run, repeated from its readings. :raises NotFound: no such run, or it has none."""
    store = runtime.store
    store.diagnosis(calibration_id)
    readings = store.readings(calibration_id)
    return diagnosed(store.robot_of(calibration_id), readings), readings
