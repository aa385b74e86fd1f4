"""`python -m web.openapi` writes the checked-in OpenAPI file; the page's types are made from it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import cast

from station.service import Runtime
from web.app import create_app

FILE = Path(__file__).with_name("openapi.json")


class _NoOrchestrator:
    orchestrator = None


def text() -> str:
    """The OpenAPI document as it is kept: the routes alone decide it, no rig is needed."""
    app = create_app(cast(Runtime, _NoOrchestrator()))
    return json.dumps(app.openapi(), indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
