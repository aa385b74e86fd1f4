"""`/plans`: what a plan would measure, how long it takes and what accuracy it promises."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query

from station.people import Permission
from station.plans import Pace, make_plan
from station.records import PlanDocument
from web.bodies import Plan, Serial
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheRuntime

router = Router(prefix="/plans", tags=["plans"])


@router.get(
    "/{name}", response_model=PlanDocument, responses=documented(422), dependencies=[needs(Permission.READ)]
)
def read_plan(
    name: Plan,
    runtime: TheRuntime,
    robot_serial: Annotated[
        Serial | None, Query(description="without one, or without a file kept here: the paper's robot")
    ] = None,
) -> PlanDocument:
    """Its positions in measuring order, for one robot at the speeds of this station."""
    robot = runtime.store.robot_or_nominal(robot_serial or "unnamed")
    return make_plan(name, robot, pace=Pace.of(runtime.settings.limits)).document()
