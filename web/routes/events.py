"""`/events` for clients that poll, `/deliveries` for receivers."""

from __future__ import annotations

from typing import Annotated

from fastapi import Path, Query
from pydantic import Field

from station.people import Permission
from station.records import LARGEST_ID, Actor, Delivery, DeliveryState, Event, Record
from web.guarded import Router, needs
from web.problems import documented
from web.routes.parts import Cursor, TheRuntime, page_of

router = Router(tags=["events"])


class EventList(Record):
    """Events in chronological order."""

    items: list[Event]
    next: int | None = Field(description="`after` of the next page, null when there are no more yet")


class DeliveryList(Record):
    """The newest deliveries first."""

    items: list[Delivery]
    next: int | None = Field(description="cursor of the next page, null on the last")


@router.get("/events", response_model=EventList, dependencies=[needs(Permission.READ)])
def read_events(
    runtime: TheRuntime,
    after: Annotated[int, Query(ge=0, le=LARGEST_ID, description="number of the last event known")] = 0,
    limit: Annotated[int, Query(ge=1, le=500)] = 100,
) -> EventList:
    """Events after event number `after`; request again with the last `n` for later ones."""
    items, last = page_of(runtime.store.happenings(after=after, limit=limit + 1), limit)
    return EventList(items=items, next=last.n if last else None)


@router.get("/deliveries", response_model=DeliveryList, dependencies=[needs(Permission.READ)])
def read_deliveries(
    runtime: TheRuntime,
    state: DeliveryState | None = None,
    limit: Annotated[int, Query(ge=1, le=500)] = 100,
    cursor: Cursor = None,
) -> DeliveryList:
    """The delivery of every event to every receiver of `[[outbox....]]`."""
    found = runtime.store.deliveries(state=state, cursor=cursor, limit=limit + 1)
    items, last = page_of(found, limit)
    return DeliveryList(items=items, next=last.id if last else None)


@router.post(
    "/deliveries/{delivery_id}/resend", status_code=202, response_model=Delivery, responses=documented(404)
)
def resend(
    delivery_id: Annotated[int, Path(ge=1, le=LARGEST_ID)],
    by: Annotated[Actor, needs(Permission.MAINTAIN)],
    runtime: TheRuntime,
) -> Delivery:
    """Deliver it again, before all later ones; the receiver recognizes it by its `uid`."""
    delivery = runtime.store.resend(delivery_id)
    runtime.store.record(by, "delivery.resent", f"delivery {delivery_id}")
    return delivery
