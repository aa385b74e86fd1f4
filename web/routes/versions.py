"""`/versions`: the components of this station, for fault reports."""

from __future__ import annotations

import platform
from importlib.metadata import version

from fastapi import Request
from pydantic import Field

from station import __version__
from station.people import Permission
from station.records import DIAGNOSIS_SCHEMA, Record
from web.guarded import Router, needs
from web.live import LiveFeed
from web.routes.parts import TheRuntime

router = Router(tags=["maintenance"])

LIBRARIES = (
    "fastapi", "numpy", "paho-mqtt", "pydantic", "pymodbus", "pyserial", "scipy", "sqlite-utils", "uvicorn",
)  # fmt: skip


class Versions(Record):
    """Versions of the program and of its platform."""

    program: str
    schema_step: str = Field(description="last step that was applied to the tables of the history")
    diagnosis: str = Field(description="version of the diagnosis document")
    page: str = Field(description="build of the page")
    python: str
    system: str
    libraries: dict[str, str]


@router.get("/versions", response_model=Versions, dependencies=[needs(Permission.READ)])
def read_versions(runtime: TheRuntime, request: Request) -> Versions:
    """All versions that a fault report should contain."""
    feed: LiveFeed = request.app.state.feed
    return Versions(
        program=__version__,
        schema_step=runtime.store.schema_step(),
        diagnosis=DIAGNOSIS_SCHEMA,
        page=feed.build,
        python=platform.python_version(),
        system=platform.platform(terse=True),
        libraries={name: version(name) for name in LIBRARIES},
    )
