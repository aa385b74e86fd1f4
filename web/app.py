"""The complete service: routes, live feed, page and problem documents around one `Runtime`."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from fastapi import Depends, FastAPI

from station import __version__
from station.people import Access, OpenId
from station.service import Runtime, Timer, listens_on_loopback
from station.settings import ServiceSettings
from web import etags, methods, pages, problems
from web.application import Application
from web.borders import Borders, Forwarded
from web.compression import Compression
from web.headers import SecurityHeaders
from web.known_query import known_query
from web.late import LateCommands
from web.live import LiveFeed
from web.metrics import Metrics
from web.routes import (
    audit,
    backups,
    calibrations,
    certificates,
    datasets,
    devices,
    diagnoses,
    emulator,
    error_maps,
    events,
    gauge_studies,
    health,
    keys,
    live,
    metrics,
    openid,
    plans,
    quality,
    readings,
    retract,
    robots,
    run_table,
    scans,
    sessions,
    station,
    stop,
    training,
    users,
    versions,
    wire,
)
from web.slow_bodies import SlowBodies

API = "/api/v1"
DESCRIPTION = """Zero-offset calibration of a 2-DOF five-bar robot, for the operator's page and the MES alike.

State is pushed on the WebSocket `/api/v1/live`: first a snapshot, then numbered events, a beat each second.
Errors are problem documents (RFC 9457)."""


NOTE_USE_S = 60.0
ROUTES = (
    station, audit, backups, calibrations, certificates, datasets, devices, diagnoses, emulator, error_maps,
    events, gauge_studies, keys, plans, quality, readings, retract, robots, run_table, scans, sessions, stop,
    training, users, versions, wire,
)  # fmt: skip
LIVE_ROUTES = (live,)
PROVIDER_ROUTES = (openid,)
"""Routes that a provider redirects to, where it may add query parameters."""
TOP_ROUTES = (metrics,)
"""Routes at the addresses that standard tools expect."""


def create_app(runtime: Runtime, *, access: Access | None = None, static: Path = pages.STATIC) -> FastAPI:
    """The ASGI application on top of a running station.

    :param access: the permissions; by default those of the station's settings
    """
    service, openid_settings = runtime.settings.service, runtime.settings.openid
    access = access or access_of(runtime, service.host)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        noting = Timer("use of keys and sessions", access.note_use, NOTE_USE_S, first_s=NOTE_USE_S)
        with app.state.feed.attached(), app.state.metrics.attached(), noting:
            yield

    app = Application(
        title="Five-bar calibration station",
        version=__version__,
        description=DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
        responses=problems.RESPONSES,
    )
    app.state.access = access
    app.state.runtime = runtime
    app.state.openid = OpenId(openid_settings, runtime.store) if openid_settings else None
    app.state.feed = LiveFeed(runtime.orchestrator, build=pages.build_id(static), open=access.open)
    app.state.metrics = Metrics(runtime, lambda: app.state.feed.clients)
    _add_routes(app)
    pages.add(app, static)
    problems.add(app)
    _add_middleware(app, service)
    return app


def _add_routes(app: Application) -> None:
    for module in ROUTES:
        app.include_router(module.router, prefix=API, dependencies=[Depends(known_query)])
    for module in (*LIVE_ROUTES, *PROVIDER_ROUTES):
        app.include_router(module.router, prefix=API)
    app.include_router(health.router)
    for module in TOP_ROUTES:
        app.include_router(module.router)


def _add_middleware(app: Application, service: ServiceSettings) -> None:
    """The middleware added last is the first to receive a request."""
    app.add_middleware(SlowBodies)
    app.add_middleware(LateCommands)
    app.add_middleware(etags.ETags, prefix=f"{API}/calibrations/")
    app.add_middleware(Compression)
    app.add_middleware(Borders, hosts=service.hosts)
    app.add_middleware(Forwarded, proxies=service.trusted_proxies)
    app.add_middleware(SecurityHeaders)
    app.add_middleware(methods.HeadAsGet)


def access_of(runtime: Runtime, host: str) -> Access:
    """The permissions of a station that listens at this address."""
    service, orchestrator = runtime.settings.service, runtime.orchestrator
    return Access(
        runtime.store,
        open=service.open and orchestrator.emulated and listens_on_loopback(host),
        idle_s=service.sign_off_min * 60,
        busy=lambda: orchestrator.running is not None,
    )
