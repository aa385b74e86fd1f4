"""Files in a request, as a CSV body or as a multipart form: of limited size, whole or refused."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import PureWindowsPath
from typing import Any

from fastapi import Request
from python_multipart.multipart import parse_options_header
from starlette.datastructures import UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.types import Message

from station.run_kinds import Upload

CSV, FORM = "text/csv", "multipart/form-data"
LONGEST_NAME = 100
UNNAMED = "measurement file"


@dataclass(frozen=True, slots=True)
class Uploaded:
    """The received files by field name, and other fields as text."""

    files: Mapping[str, Upload]
    fields: Mapping[str, str]


def csv_or_form(*files: str, fields: Mapping[str, Any]) -> dict[str, Any]:
    """The OpenAPI description of such a body; a CSV body is the first of the files."""
    binary = {"type": "string", "contentMediaType": CSV}
    properties = {**dict.fromkeys(files, binary), **fields}
    form = {"type": "object", "properties": properties, "required": [files[0]]}
    content = {CSV: {"schema": {"type": "string"}}, FORM: {"schema": form}}
    return {"requestBody": {"required": True, "content": content}}


async def uploaded(request: Request, *files: str) -> Uploaded:
    """The body's files, of which the first is required.

    :raises HTTPException: the content type is another, the body is too large or truncated, or the form is
    invalid.
    """
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind not in (CSV, FORM):
        raise HTTPException(415, f"Send the measurement file as {CSV}, or as field `{files[0]}` of {FORM}.")
    content = await _content(request)
    if kind == CSV:
        return Uploaded({files[0]: Upload(UNNAMED, content)}, {})
    return await _form(request, content, files)


async def _content(request: Request) -> bytes:
    largest = round(request.app.state.runtime.settings.service.body_mb * 1e6)
    content = bytearray()
    try:
        async for chunk in request.stream():
            content += chunk
            if len(content) > largest:
                raise HTTPException(
                    413,
                    f"The upload is larger than {largest} bytes; send the readings alone, or fewer.",
                )
    except ClientDisconnect as gone:
        raise HTTPException(400, "The upload was cut off; send it again.") from gone
    return bytes(content)


async def _form(request: Request, content: bytes, wanted: tuple[str, ...]) -> Uploaded:
    async def receive() -> Message:
        return {"type": "http.request", "body": content, "more_body": False}

    boundary = parse_options_header(request.headers["content-type"])[1].get(b"boundary")
    if boundary and b"--%b--" % boundary not in content:
        raise HTTPException(400, "The form was cut off; send it again.")
    files: dict[str, Upload] = {}
    fields: dict[str, str] = {}
    # read a second time from memory: the parser itself has no limit for files
    async with Request(request.scope, receive).form(max_files=len(wanted), max_fields=10) as form:
        for name, part in form.multi_items():
            if isinstance(part, UploadFile) != (name in wanted) or name in files or name in fields:
                raise HTTPException(
                    422, f"Field `{name}` is out of place; files are {', '.join(wanted)}, each once."
                )
            if isinstance(part, UploadFile):
                files[name] = Upload(_shown(part.filename) or UNNAMED, await part.read())
            else:
                fields[name] = part
    if wanted[0] not in files:
        raise HTTPException(422, f"The form has no file `{wanted[0]}`; send the measurement file there.")
    return Uploaded(files, fields)


def _shown(name: str | None) -> str:
    """A file's name without its folder, printable."""
    last = PureWindowsPath(name or "").name  # accepts both kinds of slashes
    return "".join(c for c in last if c.isprintable())[:LONGEST_NAME]
