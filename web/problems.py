"""Every error as a problem document (RFC 9457): type, title, status, detail, and the field at fault."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable, Mapping
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel, Field
from starlette.exceptions import HTTPException

from station.diagnosis import TargetRefused
from station.errors import (
    Busy,
    FieldRefused,
    Forbidden,
    InputRefused,
    KeyReused,
    NotApplicable,
    NotFound,
    NotSignedIn,
    StoreUnavailable,
    TooManyTries,
)
from station.records import Phrase, said
from web.live_messages import LIVE_MESSAGE
from web.methods import allowed

MEDIA_TYPE = "application/problem+json"
RETRY_AFTER = {"Retry-After": "5"}
"""Retry delay of transient problems: s."""


class FieldAtFault(BaseModel):
    """One error in a request."""

    field: str
    detail: str


class Problem(BaseModel):
    """RFC 9457 problem document."""

    type: str = Field(
        description="`urn:station:problem:<kind>`, or `about:blank` when the status says it all"
    )
    title: str
    status: int
    detail: str
    field: str | None = Field(default=None, description="the first field at fault")
    errors: list[FieldAtFault] | None = None
    calibration_id: int | None = Field(default=None, description="the run that holds the rig or the key")
    said: Phrase | None = Field(default=None, description="`detail` by its code, for other languages")
    missing: list[str] | None = Field(default=None, description="what keeps the station from being ready")


class ProblemResponse(JSONResponse):
    media_type = MEDIA_TYPE


def problem(
    status: int,
    detail: str,
    *,
    kind: str | None = None,
    headers: Mapping[str, str] | None = None,
    **more: Any,
) -> ProblemResponse:
    """The answer for an error; `more` are the extension members that apply."""
    document = Problem(
        type=f"urn:station:problem:{kind}" if kind else "about:blank",
        title=HTTPStatus(status).phrase,
        status=status,
        detail=detail,
        **more,
    )
    return ProblemResponse(document.model_dump(exclude_none=True), status_code=status, headers=headers)


def documented(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The `responses` of a route that may answer these problems."""
    schema = {"$ref": "#/components/schemas/Problem"}
    return {
        status: {"description": HTTPStatus(status).phrase, "content": {MEDIA_TYPE: {"schema": schema}}}
        for status in statuses
    }


RESPONSES = documented(401, 403, 422, 500, 503)
"""Answers of any route."""


def add_schema(document: dict[str, Any]) -> dict[str, Any]:
    """The OpenAPI document with the schemas that no route names: problems, and messages of the live feed."""
    reference = "#/components/schemas/{model}"
    problem_schema = Problem.model_json_schema(ref_template=reference)
    live = LIVE_MESSAGE.json_schema(ref_template=reference, mode="serialization")
    schemas = document["components"]["schemas"]
    for schema in (problem_schema, live):
        for name, definition in schema.pop("$defs").items():
            schemas.setdefault(name, definition)
    schemas.update({"Problem": problem_schema, "LiveMessage": live})
    return document


PLAIN: Mapping[type[Exception], tuple[int, str]] = {
    InputRefused: (422, "refused"),
    NotFound: (404, "not-found"),
    NotApplicable: (409, "not-applicable"),
    Forbidden: (403, "forbidden"),
}
"""Errors whose text is the whole answer, with status and kind."""


def _in_its_own_words(status: int, kind: str) -> Callable[[Request, Exception], Awaitable[ProblemResponse]]:
    async def answer(request: Request, error: Exception) -> ProblemResponse:
        return problem(status, str(error), kind=kind)

    return answer


def add(app: FastAPI) -> None:
    """Turn every exception that leaves a route into its problem document."""
    for error_class, (status, kind) in PLAIN.items():
        app.add_exception_handler(error_class, _in_its_own_words(status, kind))

    @app.exception_handler(RequestValidationError)
    async def invalid(request: Request, error: RequestValidationError) -> ProblemResponse:
        errors = [FieldAtFault(field=_field(e["loc"]), detail=said(e)) for e in error.errors()]
        first = errors[0]
        return problem(
            422, f"{first.field}: {first.detail}", kind="invalid", field=first.field, errors=errors
        )

    @app.exception_handler(FieldRefused)
    async def field_refused(request: Request, error: FieldRefused) -> ProblemResponse:
        errors = [FieldAtFault(field=error.field, detail=str(error))]
        return problem(422, str(error), kind="refused", field=error.field, errors=errors)

    @app.exception_handler(TargetRefused)
    async def target_refused(request: Request, error: TargetRefused) -> ProblemResponse:
        errors = [FieldAtFault(field=error.field, detail=str(error))]
        return problem(422, str(error), kind="refused", field=error.field, errors=errors, said=error.said)

    @app.exception_handler(Busy)
    async def busy(request: Request, error: Busy) -> ProblemResponse:
        return problem(409, str(error), kind="busy", headers=RETRY_AFTER, calibration_id=error.calibration_id)

    @app.exception_handler(StoreUnavailable)
    async def store_unavailable(request: Request, error: StoreUnavailable) -> ProblemResponse:
        text = f"The history cannot be used at this moment ({error}). Nothing was changed; try again."
        return problem(503, text, kind="store-unavailable", headers=RETRY_AFTER)

    @app.exception_handler(NotSignedIn)
    async def not_signed_in(request: Request, error: NotSignedIn) -> ProblemResponse:
        headers = {"WWW-Authenticate": 'Bearer realm="station"'}
        return problem(401, str(error), kind="not-signed-in", headers=headers)

    @app.exception_handler(TooManyTries)
    async def too_many_tries(request: Request, error: TooManyTries) -> ProblemResponse:
        headers = {"Retry-After": str(math.ceil(error.after_s))}
        return problem(429, str(error), kind="too-many-tries", headers=headers)

    @app.exception_handler(KeyReused)
    async def key_reused(request: Request, error: KeyReused) -> ProblemResponse:
        return problem(
            409,
            str(error),
            kind="key-reused",
            field="Idempotency-Key",
            calibration_id=error.calibration_id,
        )

    @app.exception_handler(HTTPException)
    async def http(request: Request, error: HTTPException) -> ProblemResponse:
        headers = dict(error.headers or {})
        if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
            headers["Allow"] = allowed(app.routes, request.url.path)
        return problem(error.status_code, str(error.detail), headers=headers)

    @app.exception_handler(Exception)
    async def unexpected(request: Request, error: Exception) -> ProblemResponse:
        # the server closes the connection after an exception; the answer announces it
        headers = {"Connection": "close"}
        return problem(500, "The service failed at this request; its log has the cause.", headers=headers)


def _field(location: tuple[int | str, ...]) -> str:
    """`("body", "robot_serial")` -> `robot_serial`; only the location if there is no name."""
    return ".".join(str(part) for part in location[1:]) or str(location[0])
