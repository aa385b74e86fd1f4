"""`/stop`: the quick stop, past every queue."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Header
from starlette.exceptions import HTTPException

from web.aside import aside
from web.bodies import StopSent
from web.problems import documented
from web.routes.parts import TheRuntime

STOP_TIMEOUT_S = 3.0

router = APIRouter(tags=["stop"])


@router.post("/stop", response_model=StopSent, responses=documented(504))
async def stop(
    runtime: TheRuntime,
    operator: Annotated[
        str | None, Header(alias="X-Operator", max_length=64, description="for the log")
    ] = None,
) -> StopSent:
    """Stop both axes now.  Not the emergency stop: it needs this program, the network and the drives."""
    who = operator or "REST"
    try:
        await aside(lambda: runtime.orchestrator.stop(who), timeout_s=STOP_TIMEOUT_S)
    except TimeoutError as late:
        raise HTTPException(
            504, "The stop was sent but no drive confirmed it. Use the emergency stop."
        ) from late
    return StopSent(by=who)
