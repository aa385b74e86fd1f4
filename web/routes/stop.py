"""`/stop`: the quick stop, past every queue."""

from __future__ import annotations

from fastapi import APIRouter

from web.aside import aside
from web.bodies import Stopped
from web.problems import FieldAtFault, ProblemResponse, documented, problem
from web.routes.parts import CallerName, TheRuntime

STOP_TIMEOUT_S = 3.0
REMEDY = "Use the emergency stop."

router = APIRouter(tags=["stop"])


@router.post("/stop", response_model=Stopped, responses=documented(502, 504))
async def stop(runtime: TheRuntime, operator: CallerName = None) -> Stopped | ProblemResponse:
    """Stop both axes now.  Not the emergency stop: it needs this program, the network and the drives."""
    who = operator or "REST"
    try:
        outcome = await aside(lambda: runtime.orchestrator.stop(who), timeout_s=STOP_TIMEOUT_S)
    except TimeoutError:
        return problem(504, f"No drive confirmed the stop. {REMEDY}", kind="stop-not-confirmed")
    failed = [FieldAtFault(field=axis, detail=text) for axis, text in outcome.items() if text]
    if failed:
        texts = "; ".join(f"{axis.field}: {axis.detail}" for axis in failed)
        return problem(502, f"{texts}. {REMEDY}", kind="stop-not-confirmed", errors=failed)
    return Stopped(by=who)
