"""The application that describes itself by the checked-in OpenAPI file."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from fastapi import FastAPI
from pydantic import JsonValue

FILE = Path(__file__).with_name("openapi.json")


class Application(FastAPI):
    """To make the description anew takes a second, during which nobody could stop the machine."""

    def openapi(self) -> dict[str, JsonValue]:
        """The file, which a test holds to what the routes say."""
        return kept_description()


@cache
def kept_description() -> dict[str, JsonValue]:
    """Read once a process."""
    document: dict[str, JsonValue] = json.loads(FILE.read_text(encoding="utf-8"))
    return document
