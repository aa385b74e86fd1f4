"""`/calibrations/{id}/wire`: the wire traffic of a run, request by request."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query
from pydantic import Field

from station.motion import exchanges
from station.people import Permission
from station.records import LARGEST_ID, Record, WireExchange
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import CalibrationId, TheRuntime

router = Router(prefix="/calibrations/{calibration_id}", tags=["maintenance"])


class WireList(Record):
    """Exchanges in chronological order."""

    items: list[WireExchange]
    next: int | None = Field(description="cursor of the next page, null on the last")


@router.get(
    "/wire", response_model=WireList, responses=documented(404), dependencies=[needs(Permission.READ)]
)
def read_wire(
    calibration_id: CalibrationId,
    runtime: TheRuntime,
    limit: Annotated[int, Query(ge=1, le=500)] = 100,
    cursor: Annotated[
        int, Query(ge=0, le=LARGEST_ID, description="`next` of the page before: how many to pass over")
    ] = 0,
) -> WireList:
    """Each request with its answer and the elapsed time. As `station wire`."""
    header, *lines = runtime.store.wire_log(calibration_id)
    items = exchanges(header, lines)
    end = cursor + limit
    return WireList(items=items[cursor:end], next=end if len(items) > end else None)
