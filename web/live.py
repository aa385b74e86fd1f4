"""The live feed: a full snapshot first, then numbered events, and a beat each second.

A client that falls behind gets a snapshot instead of an ever longer queue, so that a late client, a slow one
and one that reconnects are the same case. A snapshot may already contain the facts of the events directly
after it: events state facts by id, so applying one twice changes nothing.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime

from pydantic_core import to_json

from station.service import LiveEvent, Orchestrator
from web.aside import aside

BEAT_S = 1.0
QUEUE_LENGTH = 256

Send = Callable[[str], Awaitable[None]]


class LiveFeed:
    """Numbers the orchestrator's events and sends them to every client."""

    def __init__(
        self,
        orchestrator: Orchestrator,
        *,
        build: str,
        open: bool = False,
        beat_s: float = BEAT_S,
        queue_length: int = QUEUE_LENGTH,
    ) -> None:
        self.build = build
        self._orchestrator, self._open = orchestrator, open
        self._beat_s = beat_s
        self._queue_length = queue_length
        self._number = 0
        self._clients: set[_Client] = set()

    @property
    def clients(self) -> int:
        """Number of connected clients."""
        return len(self._clients)

    @contextmanager
    def attached(self) -> Iterator[None]:
        """Subscribe to the orchestrator, from within the running event loop."""
        loop = asyncio.get_running_loop()

        def from_worker(event: LiveEvent) -> None:
            loop.call_soon_threadsafe(self._publish, event)

        unsubscribe = self._orchestrator.subscribe(from_worker)
        try:
            yield
        finally:
            unsubscribe()

    async def serve(self, send: Send) -> None:
        """Serve one client until it is cancelled or `send` fails."""
        client = _Client(self._queue_length)
        self._clients.add(client)
        clock = asyncio.get_running_loop().time
        next_beat = clock() + self._beat_s
        try:
            while True:
                if client.behind:
                    client.behind, client.sent = False, self._number
                    await send(await self._snapshot(self._number))
                message = await client.next(next_beat)
                if message is not None:
                    await send(message)
                if clock() >= next_beat:
                    next_beat = clock() + self._beat_s
                    await send(self._message("beat", client.sent))
        finally:
            self._clients.remove(client)

    def _publish(self, event: LiveEvent) -> None:
        self._number += 1
        message = self._message(event.type, self._number, event.data)
        for client in self._clients:
            client.offer(self._number, message)

    async def _snapshot(self, number: int) -> str:
        # aside: a worker that hangs while it holds the orchestrator must not stop the beats
        station = await aside(self._orchestrator.snapshot)
        return self._message("snapshot", number, station.as_open(self._open))

    def _message(self, kind: str, number: int, data: object = None) -> str:
        message = {"type": kind, "number": number, "at": datetime.now(UTC), "build": self.build, "data": data}
        return to_json(message, by_alias=True, inf_nan_mode="null").decode()


class _Client:
    """A bounded queue; when it overflows, its content is dropped and the client gets a snapshot."""

    def __init__(self, length: int) -> None:
        self.behind = True
        self.sent = 0
        self._queue: asyncio.Queue[tuple[int, str]] = asyncio.Queue(length)

    def offer(self, number: int, message: str) -> None:
        if self.behind:
            return
        if self._queue.full():
            self.behind = True
            while not self._queue.empty():
                self._queue.get_nowait()
            return
        self._queue.put_nowait((number, message))

    async def next(self, deadline: float) -> str | None:
        """The next message, or None at the deadline of the event loop's clock."""
        try:
            async with asyncio.timeout_at(deadline):
                self.sent, message = await self._queue.get()
        except TimeoutError:
            return None
        return message
