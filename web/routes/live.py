"""`/live`: the WebSocket of `web.live`.  State only; commands go through the other routes."""

from __future__ import annotations

import asyncio
from contextlib import suppress

from fastapi import APIRouter, WebSocket
from starlette.websockets import WebSocketDisconnect

from web.headers import same_origin
from web.live import LiveFeed

FOREIGN_ORIGIN = 1008

router = APIRouter()


@router.websocket("/live")
async def live(websocket: WebSocket) -> None:
    """Feed the client until either side leaves."""
    # WebSockets skip CORS: without this check any site's page could watch the station
    if not same_origin(websocket.headers):
        await websocket.close(FOREIGN_ORIGIN)
        return
    await websocket.accept()
    feed: LiveFeed = websocket.app.state.feed
    async with asyncio.TaskGroup() as tasks:
        feeding = tasks.create_task(_feed(feed, websocket))
        while (await websocket.receive())["type"] != "websocket.disconnect":
            pass
        feeding.cancel()


async def _feed(feed: LiveFeed, websocket: WebSocket) -> None:
    # who is gone is found out by sending as well as by receiving
    with suppress(WebSocketDisconnect):
        await feed.serve(websocket.send_text)
