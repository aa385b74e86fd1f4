"""`/calibrations/{id}/readings`: the measurement file of a run, as JSON and as CSV."""

from __future__ import annotations

from station.people import Permission
from station.records import readings_to_csv
from web.bodies import ReadingAnswer, ReadingList
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import CalibrationId, CsvResponse, TheRuntime

router = Router(prefix="/calibrations/{calibration_id}", tags=["readings"])


RUN_UID = "Run-Uid"


@router.get(
    "/readings", response_model=ReadingList, responses=documented(404), dependencies=[needs(Permission.READ)]
)
def list_readings(calibration_id: CalibrationId, runtime: TheRuntime) -> ReadingList:
    """Every reading of the run, in the order taken."""
    return ReadingList(
        items=[ReadingAnswer.of(reading) for reading in runtime.store.readings(calibration_id)]
    )


@router.get(
    "/readings.csv",
    response_class=CsvResponse,
    responses=documented(404),
    dependencies=[needs(Permission.READ)],
)
def download_readings(calibration_id: CalibrationId, runtime: TheRuntime) -> CsvResponse:
    """The measurement file itself, an imported one as it was sent; the header `Run-Uid` says of which run."""
    name = f"calibration-{calibration_id}-readings.csv"
    uid = runtime.store.summary(calibration_id).uid
    return CsvResponse(
        readings_to_csv(runtime.store.readings(calibration_id)),
        headers={"Content-Disposition": f'attachment; filename="{name}"', RUN_UID: uid},
    )
