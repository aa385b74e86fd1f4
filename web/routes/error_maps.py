"""`/calibrations/{id}/error-map`: the expected position error over the workspace, before and after a run."""

from __future__ import annotations

from station.people import Permission
from station.records import ErrorMap
from station.run_kinds import error_map
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import CalibrationId, TheRuntime

router = Router(prefix="/calibrations/{calibration_id}", tags=["calibrations"])


@router.get(
    "/error-map",
    response_model=ErrorMap,
    responses=documented(404, 409),
    dependencies=[needs(Permission.READ)],
)
def read_error_map(calibration_id: CalibrationId, runtime: TheRuntime) -> ErrorMap:
    """The expected position error over the workspace, and the 95 % bound at each position.

    Computed again from the stored readings; not available for a run that identified no zero offsets.
    """
    return error_map(runtime.store, calibration_id, runtime.settings.joints)
