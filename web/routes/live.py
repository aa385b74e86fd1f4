"""`/live`: the WebSocket of `web.live`.  State only; commands go through the other routes."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from typing import Annotated

from fastapi import WebSocket
from starlette.websockets import WebSocketDisconnect

from station.errors import Forbidden, NotSignedIn, StoreUnavailable
from station.people import Access, Permission
from station.records import Actor
from web.guarded import Router, needs, who_asks
from web.live import LiveFeed

NOT_SIGNED_IN = 4401
"""Close code of a feed whose client is no longer signed in."""
LOOK_EVERY_S = 2.0
"""Interval at which ended sessions and revoked keys are detected."""

router = Router()


@router.websocket("/live")
async def live(websocket: WebSocket, by: Annotated[Actor, needs(Permission.READ)]) -> None:
    """Serve the client until either side leaves, or it may no longer watch."""
    await websocket.accept()
    feed: LiveFeed = websocket.app.state.feed
    async with asyncio.TaskGroup() as tasks:
        feeding = tasks.create_task(_feed(feed, websocket))
        watching = tasks.create_task(_watch(websocket))
        while (await websocket.receive())["type"] != "websocket.disconnect":
            pass
        feeding.cancel()
        watching.cancel()


async def _feed(feed: LiveFeed, websocket: WebSocket) -> None:
    # a departed client is detected by sending as well as by receiving
    with suppress(WebSocketDisconnect):
        await feed.serve(websocket.send_text)


async def _watch(websocket: WebSocket) -> None:
    while True:
        await asyncio.sleep(LOOK_EVERY_S)
        try:
            Access.check(await who_asks(websocket), Permission.READ)
        except StoreUnavailable:
            continue
        except (NotSignedIn, Forbidden) as ended:
            with suppress(WebSocketDisconnect, RuntimeError):
                await websocket.close(NOT_SIGNED_IN, str(ended)[:120])
            return
