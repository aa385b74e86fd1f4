"""`python -m web.openapi` writes the checked-in OpenAPI file; the page's types are made from it."""

from __future__ import annotations

import json
from typing import cast

from fastapi import FastAPI

from station.people import Access
from station.service import Runtime
from station.settings import Settings
from station.store import Store
from web import problems
from web.app import create_app
from web.application import FILE


class _NoStation:
    orchestrator = None
    settings = Settings()


def text() -> str:
    """The OpenAPI document as checked in: only the routes determine it, no rig is needed."""
    app = create_app(cast(Runtime, _NoStation()), access=Access(cast(Store, None), open=False))
    document = problems.add_schema(FastAPI.openapi(app))
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
