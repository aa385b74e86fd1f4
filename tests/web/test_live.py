"""The live feed: snapshot, numbers, beat, slow clients, origin."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from typing import Any, cast

import pytest
from starlette.websockets import WebSocketDisconnect

from station.motion.events import LiveEvent
from station.plans import PLANS
from station.records import CalibrationHolds, MachineView, RetractView, StationInfo, StationView, Workspace
from station.service.orchestrator import Orchestrator
from tests.web.conftest import Service
from web.live import LiveFeed

LIVE = "ws://station/api/v1/live"


def until(socket: Any, kind: str) -> list[Any]:
    """Messages up to and including the first of this type."""
    messages = [socket.receive_json()]
    while messages[-1]["type"] != kind:
        messages.append(socket.receive_json())
    return messages


def test_a_snapshot_first_then_numbered_events_to_the_end_of_the_run(service: Service) -> None:
    with service.client.websocket_connect(LIVE) as socket:
        snapshot = socket.receive_json()
        assert snapshot["type"] == "snapshot"
        assert snapshot["data"].keys() == service.client.get("/api/v1/station").json().keys()
        assert snapshot["data"]["station"]["plans"] == list(PLANS)
        service.start()
        events = [m for m in until(socket, "ended") if m["type"] != "beat"]
    first = snapshot["number"] + 1
    assert [m["number"] for m in events] == list(range(first, first + len(events)))
    assert [m["data"]["reading"] for m in events if m["type"] == "reading"] == [1, 2, 3, 4, 5, 6]
    assert {"run", "walk", "reading", "residuals", "machine", "ended"} <= {m["type"] for m in events}
    assert events[-1]["data"]["verdict"] == "pass"


def test_a_late_joiner_sees_the_whole_run(service: Service) -> None:
    run = service.hold()
    with service.client.websocket_connect(LIVE) as socket:
        seen = socket.receive_json()["data"]["run"]
    assert seen["id"] == run
    assert [stop["position"] for stop in seen["stops"]] == ["p1", "p2", "p3"]


def test_a_beat_comes_each_second_and_repeats_the_last_number(service: Service) -> None:
    with service.client.websocket_connect(LIVE) as socket:
        messages = until(socket, "beat") + until(socket, "beat")
    last = messages[0]["number"]
    for message in messages[1:]:
        last += message["type"] != "beat"
        assert message["number"] == last
        assert message["build"] and message["at"]


def test_another_sites_page_may_not_watch(service: Service) -> None:
    with (
        pytest.raises(WebSocketDisconnect),
        service.client.websocket_connect(LIVE, headers={"Origin": "http://elsewhere"}),
    ):
        pass
    with service.client.websocket_connect(LIVE, headers={"Origin": "http://station"}) as socket:
        assert socket.receive_json()["type"] == "snapshot"


def test_what_a_client_sends_is_ignored(service: Service) -> None:
    with service.client.websocket_connect(LIVE) as socket:
        socket.send_text('{"type": "stop"}')
        assert socket.receive_json()["type"] == "snapshot"
        until(socket, "beat")
    assert "axis 1 quick_stop" not in service.rig.script.calls


class Source:
    """An orchestrator as far as the feed sees it."""

    def __init__(self) -> None:
        self.publish: Callable[[LiveEvent], None] = lambda event: None

    def subscribe(self, listener: Callable[[LiveEvent], None]) -> Callable[[], None]:
        self.publish = listener
        return lambda: None

    def snapshot(self) -> StationView:
        nowhere = float("nan")
        return StationView(
            station=StationInfo(name="source", emulated=True, limits={}, plans=(), recommended_plan="full"),
            devices=(),
            interlocks=(),
            machine=MachineView(
                theta1_deg=nowhere,
                theta2_deg=nowhere,
                x_mm=nowhere,
                y_mm=nowhere,
                scale_mm=nowhere,
                age_s=0.0,
            ),
            workspace=Workspace(x=(-240, 240), y=(-782, -632)),
            retract=RetractView(needed=False, excess_mm=None, text=""),
            calibration=CalibrationHolds(robot_serial="FB-1", locked=False, text=""),
            run=None,
            last=None,
        )


def at(x_mm: float) -> MachineView:
    """Live values that a number tells from others."""
    return MachineView(theta1_deg=0.0, theta2_deg=180.0, x_mm=x_mm, y_mm=0.0, scale_mm=0.0, age_s=0.0)


def make_feed(**options: Any) -> tuple[Source, LiveFeed]:
    source = Source()
    return source, LiveFeed(cast(Orchestrator, source), build="b", **options)


def test_a_slow_client_gets_a_snapshot_instead_of_a_longer_queue() -> None:
    source, feed = make_feed(queue_length=10)

    async def scenario() -> list[Any]:
        received: list[Any] = []
        stuck, free = asyncio.Event(), asyncio.Event()

        async def send(text: str) -> None:
            received.append(json.loads(text))
            if len(received) == 2:
                stuck.set()
                await free.wait()

        with feed.attached():
            serving = asyncio.create_task(feed.serve(send))
            while not received:
                await asyncio.sleep(0.001)
            source.publish(LiveEvent("machine", at(1)))
            await stuck.wait()
            for value in range(2, 1001):
                source.publish(LiveEvent("machine", at(value)))
            await asyncio.sleep(0.05)
            free.set()
            while received[-1]["type"] != "snapshot":
                await asyncio.sleep(0.001)
            source.publish(LiveEvent("machine", at(1001)))
            while received[-1]["type"] == "snapshot":
                await asyncio.sleep(0.001)
            serving.cancel()
            await asyncio.gather(serving, return_exceptions=True)
        return received

    received = asyncio.run(scenario())
    assert [(m["type"], m["number"]) for m in received] == [
        ("snapshot", 0),
        ("machine", 1),
        ("snapshot", 1000),
        ("machine", 1001),
    ]
    assert received[0]["data"]["machine"]["scale_mm"] is None


def test_beats_go_on_while_events_flow() -> None:
    source, feed = make_feed(beat_s=0.05)

    async def scenario() -> list[str]:
        types: list[str] = []

        async def send(text: str) -> None:
            types.append(json.loads(text)["type"])

        with feed.attached():
            serving = asyncio.create_task(feed.serve(send))
            for value in range(60):
                source.publish(LiveEvent("machine", at(value)))
                await asyncio.sleep(0.005)
            serving.cancel()
            await asyncio.gather(serving, return_exceptions=True)
        return types

    types = asyncio.run(scenario())
    assert types.count("beat") >= 3
    assert types.count("machine") >= 50
