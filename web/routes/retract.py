"""`/retract`: the way back into the workspace."""

from __future__ import annotations

from typing import Annotated

from fastapi import Response

from station.people import Permission
from station.records import Actor, CalibrationSummary
from web.bodies import ApplyBody
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import LOCATION, IdempotencyKey, TheRuntime

router = Router(tags=["station"])


@router.post(
    "/retract",
    status_code=202,
    response_model=CalibrationSummary,
    responses={202: {"description": "Started", "headers": LOCATION}, **documented(409)},
)
def retract(
    body: ApplyBody,
    by: Annotated[Actor, needs(Permission.OPERATE)],
    runtime: TheRuntime,
    response: Response,
    idempotency_key: IdempotencyKey = None,
) -> CalibrationSummary:
    """Bring the arm back into its workspace: a slow run of its own, each step reduces the distance to it."""
    submitted = runtime.orchestrator.retract(body.operator, idempotency_key=idempotency_key, by=by)
    response.headers["Location"] = f"/api/v1/calibrations/{submitted.id}"
    return runtime.store.summary(submitted.id)
