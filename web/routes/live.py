"""`/live`: the WebSocket of `web.live`.  State only; commands go through the other routes."""

from __future__ import annotations

import asyncio

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
    feeding = asyncio.create_task(feed.serve(websocket.send_text))
    leaving = asyncio.create_task(_until_left(websocket))
    _, pending = await asyncio.wait((feeding, leaving), return_when=asyncio.FIRST_COMPLETED)
    for task in pending:
        task.cancel()
    for outcome in await asyncio.gather(feeding, leaving, return_exceptions=True):
        if isinstance(outcome, Exception) and not isinstance(outcome, WebSocketDisconnect):
            raise outcome


async def _until_left(websocket: WebSocket) -> None:
    while (await websocket.receive())["type"] != "websocket.disconnect":
        pass
