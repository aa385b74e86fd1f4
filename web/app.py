"""The service put together: routes, live feed, page and problem documents around one `Runtime`."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from fastapi import Depends, FastAPI

from station import __version__
from station.service import Runtime
from web import etags, headers, methods, pages, problems
from web.known_query import known_query
from web.live import LiveFeed
from web.routes import (
    backups,
    calibrations,
    datasets,
    diagnoses,
    emulator,
    health,
    live,
    plans,
    quality,
    readings,
    retract,
    robots,
    station,
    stop,
)
from web.slow_bodies import SlowBodies

API = "/api/v1"
DESCRIPTION = """Zero-offset calibration of a 2-DOF five-bar robot, for the operator's page and the MES alike.

State is pushed on the WebSocket `/api/v1/live`: first a snapshot, then numbered events, a beat each second.
Errors are problem documents (RFC 9457)."""


def create_app(runtime: Runtime, *, static: Path = pages.STATIC) -> FastAPI:
    """The ASGI application on top of a running station."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        with app.state.feed.attached():
            yield

    app = FastAPI(
        title="Five-bar calibration station",
        version=__version__,
        description=DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
        responses=problems.RESPONSES,
    )
    app.state.runtime = runtime
    app.state.feed = LiveFeed(runtime.orchestrator, build=pages.build_id(static))
    for module in (
        station, backups, calibrations, datasets, diagnoses, emulator, plans, quality, readings, retract,
        robots, stop,
    ):  # fmt: skip
        app.include_router(module.router, prefix=API, dependencies=[Depends(known_query(API))])
    app.include_router(live.router, prefix=API)
    app.include_router(health.router)
    pages.add(app, static)
    problems.add(app)
    problems.add_schema(app.openapi())
    app.add_middleware(SlowBodies)
    app.add_middleware(etags.ETags, prefix=f"{API}/calibrations/")
    app.add_middleware(headers.SameOrigin)
    app.add_middleware(headers.SecurityHeaders)
    app.add_middleware(methods.HeadAsGet)
    return app
