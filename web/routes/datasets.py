"""`/datasets`: import of a measurement file as a run with its diagnosis. The rig is not needed."""

from __future__ import annotations

from collections.abc import Mapping
from threading import Lock
from typing import Annotated

from fastapi import Query, Request, Response
from fastapi.exceptions import RequestValidationError
from pydantic import ValidationError

from station.people import Permission
from station.records import Actor, CalibrationRequest, CalibrationSummary, ColumnMap
from station.run_kinds import Sent, import_measured
from web.aside import aside
from web.bodies import DatasetFields
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import LOCATION, IdempotencyKey, TheRuntime
from web.uploads import csv_or_form, uploaded

FILES = ("file", "fresh")

router = Router(prefix="/datasets", tags=["datasets"])
_one_at_a_time = Lock()
"""Many uploads must not take the processor from a run, and a key must not be used twice at once."""


@router.post(
    "",
    status_code=201,
    response_model=CalibrationSummary,
    responses={201: {"description": "Imported", "headers": LOCATION}, **documented(400, 409, 413, 415)},
    openapi_extra=csv_or_form(*FILES, fields=DatasetFields.model_json_schema()["properties"]),
)
async def import_measurement_file(
    request: Request,
    runtime: TheRuntime,
    response: Response,
    query: Annotated[DatasetFields, Query()],
    by: Annotated[Actor, needs(Permission.OPERATE)],
    idempotency_key: IdempotencyKey = None,
) -> CalibrationSummary:
    """Diagnose a measurement file and store it as a finished run of plan `dataset`.

    A CSV body, or a form with `file` and, to confirm the cause, `fresh`: readings taken afterwards at other
    positions. Only a result confirmed by fresh readings is a pass. A refused file leaves no data. The log of
    a serial arm needs the arm's robot file, stored with `PUT /robots/{serial}` before. A file from other
    software, also a spreadsheet, needs a column map, as text in `columns`.
    """
    sent = await uploaded(request, *FILES)
    fields = _with(query, sent.fields)
    mapping = None if fields.columns is None else ColumnMap.parse(fields.columns.encode())

    def work() -> CalibrationSummary:
        with _one_at_a_time:
            submitted = import_measured(
                runtime.store,
                CalibrationRequest(
                    kind="import",
                    robot_serial=fields.robot_serial,
                    operator=fields.operator,
                    work_order=fields.work_order,
                ),
                Sent(sent.files["file"], sent.files.get("fresh"), mapping, fields.measured, fields.hold_out),
                idempotency_key=idempotency_key,
                by=by,
            )
        return runtime.store.summary(submitted.id)

    summary = await aside(work)
    response.headers["Location"] = f"/api/v1/calibrations/{summary.id}"
    return summary


def _with(query: DatasetFields, form: Mapping[str, str]) -> DatasetFields:
    """Form fields take precedence over those of the query. :raises RequestValidationError:"""
    try:
        return DatasetFields.model_validate({**query.model_dump(exclude_unset=True), **form})
    except ValidationError as error:
        raise RequestValidationError(
            [{**e, "loc": ("body", *e["loc"])} for e in error.errors(include_url=False)]
        ) from error
