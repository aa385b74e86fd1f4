"""The page itself: accessible in every state, renewed when the server is."""

from __future__ import annotations

import json

from playwright.sync_api import Page, Route, WebSocketRoute, expect

from tests.browser.conftest import Station
from tests.browser.steps import add_run, open_station, start, violations


def test_no_state_breaks_wcag_2_2_aa(page: Page, slow_station: Station) -> None:
    open_station(page, slow_station)
    start(page)
    expect(page.locator(".readings tbody tr").first).to_be_visible()
    assert violations(page) == []
    page.get_by_role("button", name="Abort run").click()
    expect(page.locator(".outcome")).to_contain_text("ABORTED")
    assert violations(page) == []


def test_the_state_of_the_station_does_not_wait_for_the_texts(page: Page, station: Station) -> None:
    held: list[Route] = []
    page.route("**/assets/en-*.js", lambda route: held.append(route))
    with page.expect_websocket() as feed:
        page.goto(station.url, wait_until="commit")
    feed.value.wait_for_event("framereceived")
    assert len(held) == 1
    held[0].continue_()
    expect(page.locator("header")).to_contain_text("READY")


def test_the_page_comes_in_few_files(page: Page, station: Station) -> None:
    """Each more is asked for in the time to READY."""
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    open_station(page, station)
    scripts = [url for url in asked if url.endswith(".js")]
    assert len(scripts) == 4, scripts


def test_a_chart_that_cannot_be_loaded_says_so(page: Page, station: Station) -> None:
    run = add_run(station, "FB-801")
    page.route("**/assets/residual-drawing-*.js", lambda route: route.abort())
    page.goto(f"{station.url}/result/{run['id']}?open=residuals")
    expect(page.get_by_text("The chart could not be loaded")).to_be_visible()
    assert violations(page) == []


def test_a_run_that_does_not_exist_says_so(page: Page, station: Station) -> None:
    page.goto(f"{station.url}/result/99999")
    expect(page.locator("main")).to_contain_text("no calibration 99999")


def test_the_page_reloads_itself_between_runs_when_the_server_has_another_build(
    page: Page, station: Station
) -> None:
    renewed = False

    def live(socket: WebSocketRoute) -> None:
        def forward(text: str | bytes) -> None:
            message = json.loads(text)
            if renewed:
                message["build"] = "another"
            socket.send(json.dumps(message))

        socket.connect_to_server().on_message(forward)

    page.route_web_socket("**/api/v1/live", live)
    open_station(page, station)
    with page.expect_event("load"):
        renewed = True
    expect(page.locator("header")).to_contain_text("connected")


def test_a_gap_in_the_numbers_leads_to_a_new_snapshot(page: Page, station: Station) -> None:
    sockets = 0
    skip = False

    def live(socket: WebSocketRoute) -> None:
        nonlocal sockets
        sockets += 1

        def forward(text: str | bytes) -> None:
            message = json.loads(text)
            if skip and sockets == 1 and message["type"] != "snapshot":
                message["number"] += 1
            socket.send(json.dumps(message))

        socket.connect_to_server().on_message(forward)

    page.route_web_socket("**/api/v1/live", live)
    open_station(page, station)
    skip = True
    page.wait_for_timeout(1500)
    assert sockets == 2
    expect(page.locator("header")).to_contain_text("connected")


def test_the_api_documentation_draws_itself_offline(page: Page, station: Station) -> None:
    page.goto(f"{station.url}/docs")
    expect(page.locator(".opblock").first).to_be_visible()
