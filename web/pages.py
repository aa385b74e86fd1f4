"""The operator's page: its built files, and the API's documentation, both without internet access."""

from __future__ import annotations

import base64
import hashlib
import re
from pathlib import Path

import fastapi_offline
from fastapi import FastAPI
from fastapi.openapi.docs import get_swagger_ui_html
from fastapi.responses import FileResponse, HTMLResponse, Response
from fastapi.staticfiles import StaticFiles
from starlette.types import Scope

from web.problems import problem

STATIC = Path(__file__).parent / "static"
VIEWS = (
    "/",
    "/result",
    "/result/{calibration_id}",
    "/diagnosis/{calibration_id}",
    "/history",
    "/maintenance",
    "/sign-in",
)
"""The page's own addresses: each returns the same HTML, and the page shows the view."""

DOCS_FILES = Path(fastapi_offline.__file__).parent / "static"


def build_id(static: Path) -> str:
    """An identifier that changes with the built page: its HTML names every file by content hash."""
    html = static / "index.html"
    return hashlib.sha256(html.read_bytes()).hexdigest()[:12] if html.is_file() else "none"


def add(app: FastAPI, static: Path) -> None:
    """Serve the page and `/docs`."""
    for view in VIEWS:
        app.add_api_route(view, lambda: _page(static), include_in_schema=False, response_class=Response)
    app.mount("/assets", _HashedFiles(directory=static / "assets", check_dir=False), name="assets")
    app.mount("/docs-files", StaticFiles(directory=DOCS_FILES), name="docs-files")
    app.add_api_route("/docs", lambda: _docs(app), include_in_schema=False, response_class=Response)


def _page(static: Path) -> Response:
    html = static / "index.html"
    if not html.is_file():
        return problem(503, "The page is not built: run `npm ci && npm run build` in web/ui.", kind="no-page")
    return FileResponse(html, headers={"Cache-Control": "no-cache"})


class _HashedFiles(StaticFiles):
    """Files whose name changes with their content may be cached permanently."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        response = await super().get_response(path, scope)
        response.headers["Cache-Control"] = "public, max-age=31536000, immutable"
        return response


def _docs(app: FastAPI) -> HTMLResponse:
    page = get_swagger_ui_html(
        openapi_url=str(app.openapi_url),
        title=app.title,
        swagger_js_url="/docs-files/swagger-ui-bundle.js",
        swagger_css_url="/docs-files/swagger-ui.css",
        swagger_favicon_url="/docs-files/favicon.png",
    )
    page.headers["Content-Security-Policy"] = (
        f"default-src 'self'; script-src 'self' {_inline_scripts(bytes(page.body).decode())}; "
        "style-src 'self' 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'none'"
    )
    return page


def _inline_scripts(html: str) -> str:
    """The page's inline scripts as CSP hashes, so that no other can run."""
    scripts = re.findall(r"<script>(.*?)</script>", html, re.DOTALL)
    return " ".join(
        f"'sha256-{base64.b64encode(hashlib.sha256(s.encode()).digest()).decode()}'" for s in scripts
    )
