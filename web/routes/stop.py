"""`/stop`: the quick stop, past every queue."""

from __future__ import annotations

import logging

from fastapi import APIRouter, Response

from web.aside import aside
from web.bodies import Stopped
from web.routes.parts import CallerName, TheRuntime

log = logging.getLogger(__name__)

STOP_TIMEOUT_S = 3.0
NOT_CONFIRMED = 502

router = APIRouter(tags=["stop"])


@router.post(
    "/stop",
    response_model=Stopped,
    responses={NOT_CONFIRMED: {"model": Stopped, "description": "At least one axis did not confirm."}},
)
async def stop(runtime: TheRuntime, response: Response, operator: CallerName = None) -> Stopped:
    """Stop both axes now.  Not the emergency stop: it needs this program, the network and the drives."""
    orchestrator = runtime.orchestrator
    try:
        axes = await aside(lambda: orchestrator.stop(operator or "REST"), timeout_s=STOP_TIMEOUT_S)
    except TimeoutError:
        axes = dict.fromkeys(orchestrator.axes, f"no answer within {STOP_TIMEOUT_S:g} s")
    except Exception as error:  # whatever fails here: who stops must get an answer about the axes
        log.exception("The stop failed")
        axes = dict.fromkeys(orchestrator.axes, f"the stop failed ({type(error).__name__})")
    stopped = Stopped.of(axes)
    if not stopped.confirmed:
        response.status_code = NOT_CONFIRMED
    return stopped
