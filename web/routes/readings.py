"""`/calibrations/{id}/readings`: the measurement file of a run, as JSON and as CSV."""

from __future__ import annotations

from pathlib import PurePath

from fastapi import Response

from station.errors import NotApplicable
from station.people import Permission
from station.records import readings_to_csv
from web.bodies import ReadingAnswer, ReadingList
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import CalibrationId, CsvResponse, TheRuntime

router = Router(prefix="/calibrations/{calibration_id}", tags=["readings"])


RUN_UID = "Run-Uid"


@router.get(
    "/readings",
    response_model=ReadingList,
    responses=documented(404, 409),
    dependencies=[needs(Permission.READ)],
)
def list_readings(calibration_id: CalibrationId, runtime: TheRuntime) -> ReadingList:
    """Every reading of the run, in the order taken; for an arm's log only `readings.csv` has them."""
    if runtime.store.logs_of(calibration_id):
        raise NotApplicable(
            f"Run {calibration_id} was made from the log of an arm; readings.csv is that log as it was."
        )
    return ReadingList(
        items=[ReadingAnswer.of(reading) for reading in runtime.store.readings(calibration_id)]
    )


@router.get(
    "/readings.csv",
    response_class=CsvResponse,
    responses=documented(404),
    dependencies=[needs(Permission.READ)],
)
def download_readings(calibration_id: CalibrationId, runtime: TheRuntime) -> Response:
    """The measurement file itself, an imported one as received; the header `Run-Uid` identifies the run."""
    name = f"calibration-{calibration_id}-readings.csv"
    uid = runtime.store.summary(calibration_id).uid
    headers = {"Content-Disposition": f'attachment; filename="{name}"', RUN_UID: uid}
    for log in runtime.store.logs_of(calibration_id):
        if log.part == "file":
            named = name.removesuffix(".csv") + PurePath(log.name).suffix
            headers["Content-Disposition"] = f'attachment; filename="{named}"'
            return Response(log.content, media_type="application/octet-stream", headers=headers)
    return CsvResponse(readings_to_csv(runtime.store.readings(calibration_id)), headers=headers)
