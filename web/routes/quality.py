"""`/quality` and `/robots/{serial}/trend`: capability and trend of the process."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query

from station.people import Permission
from station.quality import Quality, Trend, quality, trend
from web.bodies import Serial
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import Moment, TheRuntime

router = Router(tags=["quality"])
RobotType = Annotated[str | None, Query(max_length=64, description="`type` of the robot file")]
IN_TREND = ("calibrate", "apply", "rollback", "gauge_study")


@router.get("/quality", response_model=Quality, dependencies=[needs(Permission.READ)])
def read_quality(
    runtime: TheRuntime,
    robot_serial: Serial | None = None,
    robot_type: RobotType = None,
    since: Annotated[Moment | None, Query(description="ended then or later")] = None,
) -> Quality:
    """Capability, run rules and a Pareto of outcomes over the newest finished calibrations.

    The limits and the number of runs are `[quality]` of the station file.
    """
    wanted = runtime.settings.quality
    points = runtime.store.trend(
        limit=wanted.runs, robot_serial=robot_serial, robot_type=robot_type, since=since
    )
    return quality(points, zero_offset_deg=wanted.zero_offset_deg, position_error_mm=wanted.position_error_mm)


@router.get("/trend", response_model=Trend, dependencies=[needs(Permission.READ)])
def read_station_trend(
    runtime: TheRuntime,
    robot_type: RobotType = None,
    since: Annotated[Moment | None, Query(description="ended then or later")] = None,
    limit: Annotated[int, Query(ge=1, le=5000)] = 200,
) -> Trend:
    """The newest finished runs of all robots, or of all of one type, oldest first, with control charts, also
    of effects.
    """
    store = runtime.store
    points = store.trend(limit=limit, robot_type=robot_type, since=since, kinds=IN_TREND)
    return trend(None, points, store.effects(limit=limit, robot_type=robot_type, since=since))


@router.get(
    "/robots/{serial:path}/trend",
    response_model=Trend,
    responses=documented(404),
    dependencies=[needs(Permission.READ)],
)
def read_trend(
    serial: Serial,
    runtime: TheRuntime,
    since: Annotated[Moment | None, Query(description="ended then or later")] = None,
    limit: Annotated[int, Query(ge=1, le=5000)] = 200,
) -> Trend:
    """The newest finished runs of one robot, oldest first, with control charts."""
    runtime.store.robot(serial)
    points = runtime.store.trend(limit=limit, robot_serial=serial, since=since, kinds=IN_TREND)
    effects = runtime.store.effects(limit=limit, robot_serial=serial, since=since)
    return trend(serial, points, effects)
