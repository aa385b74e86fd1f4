"""The Python client against the real application: typed answers, patience, refusals in words."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx2 as httpx
import pytest
from fastapi.testclient import TestClient

import fivebar_client
import station
from fivebar_client import CalibrationBody, Refused, Station, StationError, Unexpected, Unreachable
from tests.web.conftest import LIMIT_S, Service

CLIENT = Path(__file__).parents[2] / "web" / "client"
ORDER = CalibrationBody(robot_serial="FB-1", plan="rapid", operator="line 4", work_order="WO-7")


@pytest.fixture
def mes(closed: Service) -> Station:
    """The client of a MES; beside it somebody who operates."""
    closed.client.headers.update(closed.key("operator"))
    key = closed.key("mes")["Authorization"].removeprefix("Bearer ")
    return Station("http://station", key, patience_s=LIMIT_S, http=TestClient(closed.client.app))


def scripted(*answers: httpx.Response | Exception, patience_s: float = 0.05) -> Station:
    """A client whose station answers this."""
    told = list(answers)

    def answer(request: httpx.Request) -> httpx.Response:
        said = told.pop(0) if len(told) > 1 else told[0]
        if isinstance(said, Exception):
            raise said
        return said

    http = httpx.Client(transport=httpx.MockTransport(answer))
    return Station("http://station", "fbs_x", patience_s=patience_s, http=http)


def test_a_run_from_its_start_to_its_result(closed: Service, mes: Station) -> None:
    assert mes.view().run is None
    started = mes.start(ORDER, "WO-7/1")
    assert mes.start(ORDER, "WO-7/1").uid == started.uid
    run = mes.wait(started.id, every_s=0.01)
    assert (run.state, run.verdict, run.work_order) == ("succeeded", "pass", "WO-7")
    assert [found.id for found in mes.runs(work_order="WO-7")] == [started.id]
    assert [reading.reading for reading in mes.readings(run.id)] == list(range(1, (run.steps or 0) + 1))
    ended = [event for event in mes.events() if event.type == "run.ended"]
    assert [event.data["uid"] for event in ended] == [run.uid]
    assert not list(mes.events(after=ended[0].n))


def test_every_page_of_a_list_is_asked_for(closed: Service, mes: Station) -> None:
    for number in range(120):
        closed.runtime.store.announce("alarm", {"text": str(number)})
    assert [event.n for event in mes.events()] == list(range(1, 121))


def test_the_mes_ends_what_it_started_and_stops(closed: Service, mes: Station) -> None:
    closed.patch.setattr("station.motion.positioner._ARRIVAL_MARGIN_S", 600.0)
    closed.rig.axes[0].stuck = True
    started = mes.start(ORDER, "WO-7/1")
    closed.wait_for("axis 1 move_to")
    mes.abort(started.id)
    assert mes.wait(started.id, every_s=0.01).state == "aborted"
    stopped = mes.stop()
    assert stopped.confirmed and set(stopped.axes) == {"axis 1", "axis 2"}


def test_a_refusal_says_why(closed: Service, mes: Station) -> None:
    with pytest.raises(Refused, match="999") as refused:
        mes.run(999)
    assert refused.value.problem.status == 404
    started = mes.start(ORDER, "WO-7/1")
    with pytest.raises(Refused) as refused:
        mes.start(ORDER.model_copy(update={"plan": "full"}), "WO-7/1")
    assert refused.value.problem.status == 409
    mes.wait(started.id, every_s=0.01)
    stranger = Station("http://station", "fbs_wrong", patience_s=0.0, http=TestClient(closed.client.app))
    with pytest.raises(Refused, match="not known here"):
        stranger.stop()


def test_it_waits_while_another_run_holds_the_rig(closed: Service, mes: Station) -> None:
    other = closed.hold()
    waits = iter([0.0, 0.0])

    def sleep(_seconds: float) -> None:
        if next(waits, None) is None:
            closed.runtime.orchestrator.abort(other, "ada")
            closed.runtime.orchestrator.wait(other, LIMIT_S)
            closed.rig.axes[0].stuck = False

    closed.patch.setattr("fivebar_client.asking.time.sleep", sleep)
    assert mes.start(ORDER, "WO-7/1").id != other


def test_it_asks_again_after_the_wires_of_the_way() -> None:
    ready = httpx.Response(200, json={"axes": {}, "confirmed": True})
    away = httpx.Response(502, text="<html>Bad Gateway</html>")
    refused, slow = httpx.ConnectError("refused"), httpx.ReadTimeout("slow")
    busy = httpx.Response(503, headers={"Retry-After": "0"}, json={})
    runs = httpx.Response(200, json={"items": [], "next": None})
    patient = scripted(refused, away, busy, runs, patience_s=LIMIT_S)
    assert not list(patient.runs())
    for lasting in (refused, away, slow):
        with pytest.raises(Unreachable):
            list(scripted(lasting).runs())
    with pytest.raises(Unreachable):
        scripted(refused, ready).stop()
    assert scripted(ready).stop().confirmed
    not_confirmed = httpx.Response(502, json={"axes": {"axis 1": "no answer"}, "confirmed": False})
    assert not scripted(not_confirmed).stop().confirmed


@pytest.mark.parametrize(
    "answer",
    [httpx.Response(200, text="<html>"), httpx.Response(200, json={}), httpx.Response(418, text="tea")],
)
def test_another_server_is_not_taken_for_a_station(answer: httpx.Response) -> None:
    with pytest.raises(Unexpected):
        scripted(answer).view()
    assert issubclass(Unexpected, StationError)


def test_what_a_later_station_adds_is_passed_over(closed: Service, mes: Station) -> None:
    mes.wait(mes.start(ORDER, "WO-7/1").id, every_s=0.01)
    told: dict[str, Any] = closed.client.get("/api/v1/events").json()
    told["items"][0] |= {"type": "run.improved", "more": 1}
    (event, *_) = scripted(httpx.Response(200, json=told)).events()
    assert event.type == "run.improved"


def test_the_models_are_those_of_the_interface() -> None:
    made: dict[str, Callable[[], str]] = runpy.run_path(str(CLIENT / "make_models.py"))
    text = (CLIENT / "fivebar_client/models.py").read_text(encoding="utf-8")
    assert text.startswith(made["header"]()), "run `make reference`"
    assert fivebar_client.__version__ == station.__version__
