"""Parameter and answer types of the routes."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, TypeVar

from fastapi import Depends, Header, Path, Query, Response
from pydantic import BeforeValidator
from starlette.requests import HTTPConnection

from station.messages import Language
from station.people import Access
from station.records import LARGEST_ID
from station.service import Runtime
from web.problems import documented


async def _runtime(connection: HTTPConnection) -> Runtime:
    runtime: Runtime = connection.app.state.runtime
    return runtime


async def _access(connection: HTTPConnection) -> Access:
    access: Access = connection.app.state.access
    return access


class CsvResponse(Response):
    media_type = "text/csv"


TheAccess = Annotated[Access, Depends(_access)]
TheRuntime = Annotated[Runtime, Depends(_runtime)]
CallerName = Annotated[str | None, Header(alias="X-Operator", max_length=64, description="for the log")]
IdempotencyKey = Annotated[str | None, Header(alias="Idempotency-Key", min_length=1, max_length=255)]
LOCATION = {"Location": {"description": "the run's address", "schema": {"type": "string"}}}
"""The header of an answer that created a run, for OpenAPI."""


def file_of(media_type: str) -> dict[int | str, dict[str, Any]]:
    """Answers of a route that makes a file from a run, for OpenAPI."""
    schema = {"type": "string", "format": "binary"}
    return {200: {"content": {media_type: {"schema": schema}}}, **documented(404, 409)}


CalibrationId = Annotated[int, Path(ge=1, le=LARGEST_ID)]
InLanguage = Annotated[Language, Query(description="of the page")]


def _no_number(text: object) -> object:
    try:
        float(str(text))
    except ValueError:
        return text
    raise ValueError("must be a date or time as 2026-03-31T14:00:00Z")


T = TypeVar("T")


def page_of(found: list[T], limit: int) -> tuple[list[T], T | None]:
    """A page of the items read, of which there is one more, and its last item if another page follows."""
    return found[:limit], found[limit - 1] if len(found) > limit else None


Cursor = Annotated[int | None, Query(ge=1, le=LARGEST_ID, description="`next` of the page before")]
Moment = Annotated[datetime, BeforeValidator(_no_number)]
"""A number is refused: `2026` would be read as seconds since 1970, and the filter would match everything."""
