"""`/calibrations/{id}/gauge-study.*` and `/resume`: evaluation of gauge studies for the station."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Query, Response

from station.people import Permission
from station.records import LARGEST_ID, CalibrationSummary
from station.report import as_pdf
from station.run_kinds import StationGauge, gauge_page, station_gauge
from web.bodies import ApplyBody
from web.guarded import Router, needs
from web.headers import SELF_CONTAINED
from web.problems import documented
from web.routes.parts import CalibrationId, TheRuntime, file_of
from web.routes.starting import FOLLOWED, Operating, TheStarter

router = Router(prefix="/calibrations/{calibration_id}", tags=["quality"])
MOST_RUNS = 50


def _study(
    calibration_id: CalibrationId,
    runtime: TheRuntime,
    others: Annotated[
        list[Annotated[int, Query(ge=1, le=LARGEST_ID)]],
        Query(
            default_factory=list,
            alias="with",
            max_length=MOST_RUNS,
            description="gauge studies of other robots, evaluated together",
        ),
    ],
) -> StationGauge:
    return station_gauge(runtime.store, [calibration_id, *others], runtime.settings.quality.zero_offset_deg)


TheStudy = Annotated[StationGauge, Depends(_study)]


@router.get(
    "/gauge-study.json",
    response_model=StationGauge,
    responses=documented(404, 409),
    dependencies=[needs(Permission.READ)],
)
def read_gauge_study(study: TheStudy) -> StationGauge:
    """Components of the scatter of zero offsets, with intervals, and their sources."""
    return study


@router.get(
    "/gauge-study.html",
    response_class=Response,
    responses=file_of("text/html"),
    dependencies=[needs(Permission.READ)],
)
def gauge_study_page(study: TheStudy) -> Response:
    """The report as one self-contained page."""
    page = gauge_page(study).to_html()
    headers = {"Content-Security-Policy": SELF_CONTAINED}
    return Response(page, media_type="text/html; charset=utf-8", headers=headers)


@router.get(
    "/gauge-study.pdf",
    response_class=Response,
    responses=file_of("application/pdf"),
    dependencies=[needs(Permission.READ)],
)
def gauge_study_pdf(study: TheStudy) -> Response:
    """The report without its charts."""
    page = as_pdf(gauge_page(study))
    headers = {"Content-Disposition": f'inline; filename="gauge-study-{study.runs[0]}.pdf"'}
    return Response(page, media_type="application/pdf", headers=headers)


@router.post(
    "/resume",
    status_code=202,
    response_model=CalibrationSummary,
    responses=FOLLOWED,
)
def resume(
    calibration_id: CalibrationId, body: ApplyBody, by: Operating, starter: TheStarter
) -> CalibrationSummary:
    """Continue an interrupted gauge study after the last mounting that it finished.

    It is a separate run, which takes over the readings of that one.
    """
    return starter.follow("gauge_study", calibration_id, body.operator, by)
