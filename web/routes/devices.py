"""`/devices`: details of the devices for maintenance; `/doctor` examines them now."""

from __future__ import annotations

from typing import Literal

from pydantic import Field
from starlette.exceptions import HTTPException

from station.doctor import Finding, examine_in_service
from station.people import Permission
from station.records import DeviceDetail, Record
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheRuntime

LOOK_LIMIT_S = 60.0
"""Longer than for all devices being silent, one after the other."""

router = Router(tags=["maintenance"])


class DeviceList(Record):
    """Devices, scale first."""

    items: list[DeviceDetail]
    next: None = None


class Found(Record):
    """The result of the examination, with its parts."""

    text: str
    condition: Literal["ok", "note", "trouble"] = Field(
        description="`note`: works, but should be looked at; `trouble`: does not work"
    )
    do: str = Field(description="what to do about it; empty when there is nothing to do")
    parts: list[Found]

    @classmethod
    def of(cls, finding: Finding) -> Found:
        return cls(
            text=finding.text,
            condition=finding.condition,
            do=finding.do,
            parts=[cls.of(part) for part in finding.parts],
        )


@router.get("/devices", response_model=DeviceList, dependencies=[needs(Permission.READ)])
def read_devices(runtime: TheRuntime) -> DeviceList:
    """State, identity, age of the last answer and round trips, as known; no device is queried."""
    return DeviceList(items=list(runtime.orchestrator.device_details()))


@router.post(
    "/doctor",
    response_model=Found,
    responses=documented(409, 504),
    dependencies=[needs(Permission.MAINTAIN)],
)
def examine_devices(runtime: TheRuntime) -> Found:
    """Examine every device and its line between two runs; nothing moves. As `station doctor`."""
    settings = runtime.settings
    try:
        return Found.of(
            runtime.orchestrator.while_idle(
                lambda devices, robot: examine_in_service(settings, devices, robot), LOOK_LIMIT_S
            )
        )
    except TimeoutError as late:
        raise HTTPException(
            504, f"The examination did not end within {LOOK_LIMIT_S:g} s; a device holds its line."
        ) from late
