"""`/stop`: the quick stop, which overtakes every queue."""

from __future__ import annotations

import logging
from typing import Annotated

from fastapi import BackgroundTasks, Request, Response
from pydantic import JsonValue

from station.people import Permission
from station.records import Actor
from web.aside import aside, record_later
from web.bodies import Stopped
from web.guarded import Router, needs
from web.routes.parts import CallerName, TheRuntime

log = logging.getLogger(__name__)

STOP_TIMEOUT_S = 3.0
NOT_CONFIRMED = 502

router = Router(tags=["stop"])


@router.post(
    "/stop",
    response_model=Stopped,
    responses={NOT_CONFIRMED: {"model": Stopped, "description": "At least one axis did not confirm."}},
)
async def stop(
    by: Annotated[Actor, needs(Permission.STOP)],
    runtime: TheRuntime,
    request: Request,
    response: Response,
    later: BackgroundTasks,
    operator: CallerName = None,
) -> Stopped:
    """Stop both axes now.  Not the emergency stop: it needs this program, the network and the drives."""
    orchestrator = runtime.orchestrator
    try:
        axes = await aside(lambda: orchestrator.stop(by.name), timeout_s=STOP_TIMEOUT_S)
    except TimeoutError:
        axes = dict.fromkeys(orchestrator.axes, f"no answer within {STOP_TIMEOUT_S:g} s")
    except Exception as error:  # after any failure here the caller must still get an answer about the axes
        log.exception("The stop failed")
        axes = dict.fromkeys(orchestrator.axes, f"the stop failed ({type(error).__name__})")
    stopped = Stopped.of(axes)
    told: dict[str, JsonValue] = {"axes": dict(axes), "confirmed": stopped.confirmed}
    later.add_task(record_later, runtime.orchestrator, by, "station.stopped", "both axes", told)
    request.app.state.metrics.stopped(confirmed=stopped.confirmed)
    if not stopped.confirmed:
        response.status_code = NOT_CONFIRMED
    return stopped
