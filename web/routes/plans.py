"""`/plans`: the positions of a plan, its duration and its predicted accuracy."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query
from pydantic import Field

from station.people import Permission
from station.plans import PLANS, RECOMMENDED, Pace, make_plan
from station.records import PlanDocument, PlanName, Record
from web.bodies import Plan, Serial
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import TheRuntime

router = Router(prefix="/plans", tags=["plans"])


class PlanOffered(Record):
    name: PlanName
    recommended: bool = Field(description="where nothing speaks for another one")


class PlanList(Record):
    """Plans in the order in which they are offered."""

    items: list[PlanOffered]
    next: None = None


@router.get("", response_model=PlanList, dependencies=[needs(Permission.READ)])
def list_plans() -> PlanList:
    """Every plan that a start request may name."""
    return PlanList(items=[PlanOffered(name=name, recommended=name == RECOMMENDED) for name in PLANS])


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
