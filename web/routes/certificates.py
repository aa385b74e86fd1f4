"""`/calibrations/{id}/certificate.*`: the certificate of one run."""

from __future__ import annotations

from fastapi import Response

from station.certificate import CertificateDocument, Format, issue
from station.messages import Language
from station.people import Permission
from web.guarded import Router, needs
from web.headers import SELF_CONTAINED
from web.problems import documented
from web.routes.parts import CalibrationId, InLanguage, TheRuntime, file_of

router = Router(prefix="/calibrations/{calibration_id}", tags=["calibrations"])


@router.get(
    "/certificate.json",
    response_model=CertificateDocument,
    responses=documented(404, 409),
    dependencies=[needs(Permission.READ)],
)
def read_certificate(calibration_id: CalibrationId, runtime: TheRuntime) -> Response:
    """The certified content of the run, with its record, its hash and the station's signature."""
    return _issued(runtime, calibration_id, "json", "en")


@router.get(
    "/certificate.html",
    response_class=Response,
    responses=file_of("text/html"),
    dependencies=[needs(Permission.READ)],
)
def certificate_page(
    calibration_id: CalibrationId, runtime: TheRuntime, language: InLanguage = "en"
) -> Response:
    """One self-contained A4 page, with the JSON inside."""
    return _issued(runtime, calibration_id, "html", language)


@router.get(
    "/certificate.pdf",
    response_class=Response,
    responses=file_of("application/pdf"),
    dependencies=[needs(Permission.READ)],
)
def certificate_pdf(
    calibration_id: CalibrationId, runtime: TheRuntime, language: InLanguage = "en"
) -> Response:
    """One A4 page, with the JSON attached."""
    return _issued(runtime, calibration_id, "pdf", language)


def _issued(runtime: TheRuntime, run: int, form: Format, language: Language) -> Response:
    issued = issue(
        runtime.store, run, form, home=runtime.home, joints=runtime.settings.joints, language=language
    )
    headers = {"Content-Disposition": f'inline; filename="{issued.name}"'}
    if form == "html":
        headers["Content-Security-Policy"] = SELF_CONTAINED
    return Response(issued.content, media_type=issued.media_type, headers=headers)
