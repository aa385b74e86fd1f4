"""The application, described by the checked-in OpenAPI file."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from fastapi import FastAPI
from pydantic import JsonValue

FILE = Path(__file__).with_name("openapi.json")


class Application(FastAPI):
    """Generating the description takes a second, during which nobody could stop the machine."""

    def openapi(self) -> dict[str, JsonValue]:
        """The checked-in file, which a test compares with the routes."""
        return kept_description()


@cache
def kept_description() -> dict[str, JsonValue]:
    """Read once per process."""
    document: dict[str, JsonValue] = json.loads(FILE.read_text(encoding="utf-8"))
    return document
