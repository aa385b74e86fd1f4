"""`/robots`: the robots of this station, the data of one, and clearing its memory."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query, Request
from pydantic import JsonValue
from starlette.exceptions import HTTPException

from station.errors import FieldRefused, InputRefused
from station.machines import robot_of
from station.people import Permission
from station.records import Actor, CalibrationHolds, sections_of_toml
from station.service import Runtime
from web.aside import aside
from web.bodies import ClearBody, Robot, RobotList, Serial
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import CallerName, TheRuntime
from web.strict_json import is_json

TOML = ("application/toml", "text/toml", "text/x-toml")
ROBOT_FILE: dict[str, JsonValue] = {
    "requestBody": {
        "required": True,
        "content": {
            "application/json": {"schema": {"type": "object"}},
            "application/toml": {"schema": {"type": "string"}},
        },
    }
}

router = Router(prefix="/robots", tags=["robots"])


@router.get("", response_model=RobotList, dependencies=[needs(Permission.READ)])
def list_robots(
    runtime: TheRuntime,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    cursor: Annotated[str, Query(max_length=64, description="`next` of the page before")] = "",
) -> RobotList:
    """The latest robot file of each robot, by serial, page by page."""
    items = runtime.store.robots(cursor, limit + 1)
    more = len(items) > limit
    return RobotList(items=items[:limit], next=items[limit - 1].serial if more else None)


@router.get(
    "/{serial:path}", response_model=Robot, responses=documented(404), dependencies=[needs(Permission.READ)]
)
def read_robot(serial: Serial, runtime: TheRuntime) -> Robot:
    """Its file, and the memory of geometry and mechanism for its next run."""
    return _known(runtime, serial)


@router.post("/{serial:path}/clear-check", response_model=CalibrationHolds, responses=documented(404, 409))
def clear_check(
    serial: Serial, body: ClearBody, by: Annotated[Actor, needs(Permission.MAINTAIN)], runtime: TheRuntime
) -> CalibrationHolds:
    """An engineer permits work with the calibration after a failed check; person and reason are recorded."""
    holds = runtime.orchestrator.clear_failed_check(serial, body.operator, body.reason)
    runtime.store.record(by, "check.cleared", f"robot {serial}", after={"reason": body.reason})
    return holds


@router.put(
    "/{serial:path}",
    response_model=Robot,
    responses=documented(415),
    openapi_extra=ROBOT_FILE,
)
async def put_robot(
    serial: Serial,
    request: Request,
    by: Annotated[Actor, needs(Permission.MAINTAIN)],
    runtime: TheRuntime,
) -> Robot:
    """Store a robot file, as TOML or as JSON of the same sections; a changed one is a new version.

    Runs refer to the version that they were made with, and the memory of the old version is not used.
    """
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind in TOML:
        sections = sections_of_toml(await request.body(), f"robot {serial}")
    elif is_json(kind):
        sections = await request.json()
    else:
        raise HTTPException(415, "Send the robot file as application/toml or application/json.")
    if not isinstance(sections, dict):
        raise InputRefused("A robot file has sections; the first is [robot].")
    robot = robot_of(sections, source=f"robot {serial}")
    if robot.serial != serial:
        raise FieldRefused("robot.serial", f"The file is of robot {robot.serial}, the address of {serial}.")
    await aside(lambda: runtime.store.change_robot(by, robot))
    return await aside(lambda: _known(runtime, serial))


def _known(runtime: Runtime, serial: str) -> Robot:
    memory = runtime.store.memory(serial)
    return Robot(
        serial=serial,
        file=robot_of(runtime.store.robot_file(serial)).to_json(),
        memory=memory.summary() if memory else None,
    )


@router.delete("/{serial:path}/memory", status_code=204, responses=documented(404))
def forget(
    serial: Serial,
    by: Annotated[Actor, needs(Permission.MAINTAIN)],
    runtime: TheRuntime,
    operator: CallerName = None,
) -> None:
    """The next run starts without memory; the old memory remains stored. Repeating it is harmless."""
    runtime.store.forget(serial, by)
