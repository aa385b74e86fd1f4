"""`/retract`: the return into the workspace."""

from __future__ import annotations

from station.records import CalibrationSummary
from web.bodies import ApplyBody
from web.guarded import Router
from web.problems import documented
from web.routes.parts import LOCATION
from web.routes.starting import Operating, TheStarter

router = Router(tags=["station"])


@router.post(
    "/retract",
    status_code=202,
    response_model=CalibrationSummary,
    responses={202: {"description": "Started", "headers": LOCATION}, **documented(409)},
)
def retract(body: ApplyBody, by: Operating, starter: TheStarter) -> CalibrationSummary:
    """Bring the arm back into its workspace, in a separate slow run; each step reduces the distance to it."""
    return starter.retract(body.operator, by)
