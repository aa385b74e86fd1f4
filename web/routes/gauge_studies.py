"""`/calibrations/{id}/gauge-study.*` and `/resume`: what gauge studies say of the station."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Depends, Query, Response

from station.people import Permission
from station.records import LARGEST_ID, Actor, CalibrationSummary
from station.report import as_pdf
from station.run_kinds import StationGauge, gauge_page, station_gauge
from web.bodies import ApplyBody
from web.guarded import Router, needs
from web.problems import documented
from web.routes.calibrations import STARTED, started
from web.routes.parts import CalibrationId, IdempotencyKey, TheRuntime

router = Router(prefix="/calibrations/{calibration_id}", tags=["quality"])
MOST_RUNS = 50

_CONTENT_SECURITY_POLICY = (
    "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
)


def _of_type(media_type: str) -> dict[int | str, dict[str, Any]]:
    schema = {"type": "string", "format": "binary"}
    return {200: {"content": {media_type: {"schema": schema}}}, **documented(404, 409)}


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
    """Components of the scatter of zero offsets, with intervals, and what they come from."""
    return study


@router.get(
    "/gauge-study.html",
    response_class=Response,
    responses=_of_type("text/html"),
    dependencies=[needs(Permission.READ)],
)
def gauge_study_page(study: TheStudy) -> Response:
    """The report, as one page that needs nothing but itself."""
    page = gauge_page(study).to_html()
    headers = {"Content-Security-Policy": _CONTENT_SECURITY_POLICY}
    return Response(page, media_type="text/html; charset=utf-8", headers=headers)


@router.get(
    "/gauge-study.pdf",
    response_class=Response,
    responses=_of_type("application/pdf"),
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
    responses={**STARTED, **documented(404)},
)
def resume(
    calibration_id: CalibrationId,
    body: ApplyBody,
    by: Annotated[Actor, needs(Permission.OPERATE)],
    runtime: TheRuntime,
    response: Response,
    idempotency_key: IdempotencyKey = None,
) -> CalibrationSummary:
    """Go on with a gauge study that was interrupted, after the last mounting that it finished.

    A run of its own, which takes over the readings of that one.
    """
    submitted = runtime.orchestrator.follow(
        "gauge_study", calibration_id, body.operator, idempotency_key=idempotency_key, by=by
    )
    return started(submitted, runtime, response)
