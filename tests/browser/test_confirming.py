"""What may happen in the second in which Confirm is held: whatever it is, no motion starts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Serve, Station
from tests.browser.steps import HOLD_MS, arm, open_station, scan

SERIAL = "FB-800"
PART_MS = 400
"""Of the second."""


def press(page: Page) -> None:
    """Lay the finger on Confirm, and leave it there for less than it takes."""
    button = page.get_by_role("button", name="Confirm")
    button.hover()
    page.mouse.down()
    page.wait_for_timeout(PART_MS)
    expect(button).to_be_visible()


def started(station: Station) -> int:
    """Runs of the robot that was to be confirmed."""
    return len(station.get(f"/calibrations?robot_serial={SERIAL}")["items"])


def slide_off(page: Page) -> None:
    box = page.get_by_role("button", name="Confirm").bounding_box()
    assert box
    page.mouse.move(box["x"] + box["width"] + 40, box["y"] + 5)
    page.mouse.move(box["x"] + 5, box["y"] + 5)  # it comes back: the second begins no more


def type_into_the_serial(page: Page) -> None:
    page.get_by_label("Robot serial").evaluate("field => field.focus()")
    page.keyboard.type("FB", delay=60)


HAPPENINGS: dict[str, Callable[[Page], object]] = {
    "the scan of another robot": lambda page: scan(page, "FB-801"),
    "the scan of the same robot": lambda page: scan(page, SERIAL),
    "the scan of a badge": lambda page: scan(page, "BADGE:Bo"),
    "a scan that is no serial": lambda page: scan(page, "FB 8"),
    "Escape": lambda page: page.keyboard.press("Escape"),
    "a key": type_into_the_serial,
    "the pointer that slides off": slide_off,
    "a tab that is hidden": lambda page: page.evaluate(
        "document.dispatchEvent(new Event('visibilitychange'))"
    ),
    "another window": lambda page: page.evaluate("dispatchEvent(new Event('blur'))"),
    "a second finger on Back": lambda page: page.get_by_role("button", name="Back").dispatch_event("click"),
    "another view": lambda page: page.evaluate("history.back()"),
}


@pytest.mark.parametrize("happening", HAPPENINGS)
def test_what_comes_between_starts_nothing(page: Page, station: Station, happening: str) -> None:
    page.goto(f"{station.url}/history")
    page.get_by_role("link", name="Station", exact=True).click()
    expect(page.locator("header")).to_contain_text("connected")
    arm(page, SERIAL)
    press(page)
    HAPPENINGS[happening](page)
    page.wait_for_timeout(HOLD_MS)
    page.mouse.up()
    assert started(station) == 0


def test_the_start_of_another_client_takes_the_confirmation_back(page: Page, slow_station: Station) -> None:
    open_station(page, slow_station)
    arm(page, SERIAL)
    press(page)
    other = {"robot_serial": "FB-802", "plan": "paper", "operator": "mes"}
    run = slow_station.api.post("/calibrations", json=other).raise_for_status().json()
    expect(page.get_by_role("button", name="Confirm")).to_be_hidden()
    slow_station.api.post(f"/calibrations/{run['id']}/abort").raise_for_status()
    expect(page.get_by_role("button", name="Calibrate")).to_be_enabled()
    page.wait_for_timeout(HOLD_MS)
    page.mouse.up()
    assert started(slow_station) == 0


def test_a_key_that_stays_down_on_calibrate_does_not_confirm(page: Page, station: Station) -> None:
    open_station(page, station)
    page.get_by_label("Robot serial").fill(SERIAL)
    page.get_by_label("Operator").fill("ada")
    page.get_by_role("button", name="Calibrate").focus()
    keys = page.context.new_cdp_session(page)
    down = {"type": "keyDown", "key": "Enter", "code": "Enter", "windowsVirtualKeyCode": 13, "text": "\r"}
    keys.send("Input.dispatchKeyEvent", down)
    expect(page.get_by_role("button", name="Confirm")).to_be_focused()
    for _ in range(HOLD_MS // 50):
        keys.send("Input.dispatchKeyEvent", {**down, "autoRepeat": True})
        page.wait_for_timeout(50)
    keys.send("Input.dispatchKeyEvent", {"type": "keyUp", "key": "Enter", "windowsVirtualKeyCode": 13})
    expect(page.get_by_role("button", name="Confirm")).to_be_visible()
    page.keyboard.press("Escape")
    assert started(station) == 0


def test_a_station_that_dies_takes_the_confirmation_back(page: Page, serve: Serve, tmp_path: Path) -> None:
    station = serve(tmp_path)
    open_station(page, station)
    arm(page, SERIAL)
    press(page)
    station.kill()
    expect(page.get_by_role("button", name="Confirm")).to_be_hidden()
    station = serve(tmp_path)
    expect(page.locator("header")).to_contain_text("connected")
    page.wait_for_timeout(HOLD_MS)
    page.mouse.up()
    assert started(station) == 0


def test_what_was_confirmed_at_a_frozen_station_starts_nothing_when_it_goes_on(
    page: Page, station: Station
) -> None:
    open_station(page, station)
    arm(page, SERIAL)
    press(page)
    station.freeze()
    # its silence shows after three seconds only: until then Confirm is there, and its start is sent
    with page.expect_request("**/api/v1/calibrations") as sent:
        page.wait_for_timeout(HOLD_MS)
        page.mouse.up()
    expect(page.get_by_role("alert").filter(has_text="does not respond")).to_be_visible(timeout=15_000)
    station.thaw()
    expect(page.locator("header")).to_contain_text("connected")
    # a proxy between the two would deliver now what the browser has given up
    asked = sent.value
    kept = {
        name: value for name, value in asked.headers.items() if name.startswith(("content-t", "x-", "idem"))
    }
    late = station.api.post("/calibrations", content=asked.post_data_buffer or b"", headers=kept)
    assert late.status_code == 412
    assert started(station) == 0
