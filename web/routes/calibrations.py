"""`/calibrations`: start, list, read and abort runs."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated, Literal

from fastapi import BackgroundTasks, Depends, Query
from starlette.exceptions import HTTPException

from station.errors import Forbidden
from station.machines import robot_of
from station.people import Permission
from station.records import (
    Actor,
    Calibration,
    CalibrationRequest,
    CalibrationSummary,
    Record,
    State,
    read_taught_file,
)
from station.run_kinds import application, change_of, kind_of_plan, translated
from station.service import Runtime
from station.store import Filters, Order
from web.aside import aside, record_later
from web.bodies import (
    AnswerBody,
    ApplyBody,
    CalibrationBody,
    CalibrationList,
    TranslateBody,
    TranslatedList,
)
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import CalibrationId, CallerName, Cursor, Moment, TheRuntime
from web.routes.starting import FOLLOWED, STARTED, Operating, StarterWithoutKey, TheStarter

ABORT_TIMEOUT_S = 5.0

router = Router(prefix="/calibrations", tags=["calibrations"])


@router.post("", status_code=202, response_model=CalibrationSummary, responses=STARTED)
def start_calibration(
    body: CalibrationBody,
    by: Annotated[Actor, needs(Permission.START)],
    starter: TheStarter,
) -> CalibrationSummary:
    """Start a run. The same `Idempotency-Key` with the same body returns the same run."""
    request = CalibrationRequest(kind=kind_of_plan(body.plan), **dict(body))
    return starter.submit(request, by)


def _filters(
    search: Annotated[
        str | None, Query(max_length=64, description="how the serial begins, in any case")
    ] = None,
    robot_serial: str | None = None,
    robot_type: Annotated[str | None, Query(max_length=64, description="`type` of the robot file")] = None,
    state: State | None = None,
    verdict: Literal["pass", "fail"] | None = None,
    plan: Annotated[str | None, Query(description="as in the run, also `apply` or `dataset`")] = None,
    work_order: str | None = None,
    since: Annotated[Moment | None, Query(description="created at or after")] = None,
    until: Annotated[Moment | None, Query(description="created before")] = None,
    ended_since: Annotated[Moment | None, Query(description="ended at or after")] = None,
) -> Filters:
    return Filters(
        search, robot_serial, robot_type, state, verdict, plan, work_order, since, until, ended_since
    )


TheFilters = Annotated[Filters, Depends(_filters)]
TheOrder = Annotated[Order, Query(description="by number, or by serial in any case and then by number")]


@router.get("", response_model=CalibrationList, dependencies=[needs(Permission.READ)])
def list_calibrations(
    runtime: TheRuntime,
    filters: TheFilters,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    cursor: Cursor = None,
    order: TheOrder = "newest",
) -> CalibrationList:
    """Page by page, newest first by default."""
    page = runtime.store.calibrations(limit=limit, cursor=cursor, order=order, **asdict(filters))
    return CalibrationList(items=page.items, next=page.next)


class RunCount(Record):
    """The number of runs in a list."""

    count: int
    """At most 10,000."""
    more: bool
    """Whether there are more than that."""


@router.get("/count", response_model=RunCount, dependencies=[needs(Permission.READ)])
def count_calibrations(runtime: TheRuntime, filters: TheFilters) -> RunCount:
    """The number of runs with the same filters as the list."""
    count, more = runtime.store.count(filters)
    return RunCount(count=count, more=more)


@router.get(
    "/{calibration_id}",
    response_model=Calibration,
    responses=documented(404),
    dependencies=[needs(Permission.READ)],
)
def read_calibration(calibration_id: CalibrationId, runtime: TheRuntime) -> Calibration:
    """One run in full."""
    calibration = runtime.store.calibration(calibration_id)
    robot = robot_of(runtime.store.robot_file_of(calibration_id))
    known = {
        "machine": robot.model,
        "application": application(runtime.store, calibration),
        "prompt": runtime.orchestrator.prompt(calibration_id),
        "made_by": runtime.store.made_by(calibration_id),
        "zero_offset_tolerance_deg": robot.tolerances.zero_offset_deg,
    }
    return calibration.model_copy(update=known)


@router.post(
    "/{calibration_id}/abort",
    status_code=202,
    response_model=CalibrationSummary,
    responses=documented(404, 504),
)
async def abort_calibration(
    calibration_id: CalibrationId,
    by: Annotated[Actor, needs(Permission.ABORT)],
    runtime: TheRuntime,
    later: BackgroundTasks,
) -> CalibrationSummary:
    """End a run at once and make the machine safe; repeating it is harmless."""

    def abort() -> CalibrationSummary:
        _check_own(runtime, calibration_id, by)
        runtime.orchestrator.abort(calibration_id, by.name)
        return runtime.store.summary(calibration_id)

    later.add_task(record_later, runtime.orchestrator, by, "run.aborted", f"run {calibration_id}")

    try:
        return await aside(abort, timeout_s=ABORT_TIMEOUT_S)
    except TimeoutError as late:
        raise HTTPException(
            504, "The abort was sent but not confirmed; use the stop or the emergency stop."
        ) from late


@router.post(
    "/{calibration_id}/answer",
    response_model=CalibrationSummary,
    responses=documented(404, 409),
)
def answer_prompt(
    calibration_id: CalibrationId,
    body: AnswerBody,
    by: Operating,
    runtime: TheRuntime,
    operator: CallerName = None,
) -> CalibrationSummary:
    """Answer the prompt of a run in state `waiting`. After an impossible value it continues to wait."""
    runtime.orchestrator.answer(calibration_id, body.prompt, body.value, by.name)
    return runtime.store.summary(calibration_id)


@router.post(
    "/{calibration_id}/translate",
    response_model=TranslatedList,
    responses=documented(404, 409),
    dependencies=[needs(Permission.READ)],
)
def translate(calibration_id: CalibrationId, body: TranslateBody, runtime: TheRuntime) -> TranslatedList:
    """Convert taught joint positions to the same physical positions under the zeros of this run."""
    change = change_of(runtime.store, calibration_id, body.taught_under)
    change = change.back() if body.back else change
    positions, program = tuple(body.positions or ()), None
    if body.text is not None:
        positions, program = read_taught_file(body.text, "text")
    items = list(translated(change, positions, runtime.settings.joints))
    return TranslatedList(items=items, program=program.rewritten(items) if program else None)


@router.post(
    "/{calibration_id}/apply",
    status_code=202,
    response_model=CalibrationSummary,
    responses=FOLLOWED,
)
def apply_calibration(
    calibration_id: CalibrationId, body: ApplyBody, by: Operating, starter: TheStarter
) -> CalibrationSummary:
    """Write the zero offsets to the drives, read them back, verify at fresh positions.

    It is a separate run; if its verification fails, it restores the old zeros automatically.
    """
    return starter.follow("apply", calibration_id, body.operator, by)


@router.post(
    "/{calibration_id}/rollback",
    status_code=202,
    response_model=CalibrationSummary,
    responses=FOLLOWED,
)
def roll_back_calibration(
    calibration_id: CalibrationId, body: ApplyBody, by: Operating, starter: StarterWithoutKey
) -> CalibrationSummary:
    """Restore the old zeros, in a separate run. Repeating the request returns the same run."""
    return starter.follow("rollback", calibration_id, body.operator, by)


@router.post(
    "/{calibration_id}/separate",
    status_code=202,
    response_model=CalibrationSummary,
    responses=FOLLOWED,
)
def separate(
    calibration_id: CalibrationId, body: ApplyBody, by: Operating, starter: TheStarter
) -> CalibrationSummary:
    """Distinguish the causes that a diagnostic run left undecided, by the motion of `/separating`.

    It is a separate run: it continues the readings of that run, and new fresh readings confirm the result.
    """
    return starter.follow("separate", calibration_id, body.operator, by)


def _check_own(runtime: Runtime, calibration_id: int, by: Actor) -> None:
    """:raises Forbidden: a MES may only end runs that it started."""
    if by.role == "mes":
        starter = runtime.store.started_by(calibration_id)
        if starter is None or (starter.via, starter.name) != (by.via, by.name):
            runtime.store.summary(calibration_id)
            raise Forbidden(
                f"{by.name} has the role mes and may end only runs that it started;"
                f" run {calibration_id} is not one. The stop is open to everyone."
            )
