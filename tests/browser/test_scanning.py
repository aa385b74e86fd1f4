"""Scanner and gloves: real key events 5 ms apart, long presses; no scan ever starts a motion by itself."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Page, expect

from station.people import hashed_password, hashed_pin, secret_hash
from station.records import Actor
from station.store import Store
from tests.browser.conftest import Serve, Station
from tests.browser.steps import HOLD_MS, arm, open_station, scan, violations


def runs(station: Station) -> Any:
    return station.get("/calibrations?limit=1")["items"]


def refused(station: Station) -> list[tuple[str, str]]:
    """Subject and cause of refused scans, the newest first."""
    entries = station.get("/audit")["items"]
    return [(e["subject"], e["after"]["because"]) for e in entries if e["action"] == "scan.refused"]


def test_three_scans_and_no_touch_move_nothing(page: Page, station: Station) -> None:
    open_station(page, station)
    before = runs(station)
    for code in ("FB-1", "BADGE:Ada", "CONFIRM"):
        scan(page, code)
    notice = page.get_by_role("alert").filter(has_text="Nothing waits for a confirmation")
    expect(notice).to_be_visible()
    assert violations(page) == []
    expect(page.get_by_label("Robot serial")).to_have_value("FB-1")
    expect(page.get_by_label("Operator")).to_have_value("Ada")
    expect(page.get_by_role("button", name="Confirm")).to_be_hidden()
    expect(page.get_by_role("button", name="Calibrate")).to_be_focused()
    assert runs(station) == before
    assert refused(station)[0] == ("CONFIRM", "nothing_to_confirm")


@pytest.mark.parametrize("focus", ["Wanted accuracy", "Plan", "STOP"])
def test_a_scan_replaces_the_serial_wherever_the_focus_is(page: Page, station: Station, focus: str) -> None:
    open_station(page, station)
    scan(page, "FB-6")
    page.get_by_label("Operator").fill("ada")
    place = page.get_by_label(focus).or_(page.get_by_role("button", name=focus)).first
    place.focus()
    before = runs(station)
    scan(page, "FB 8")  # a blank presses buttons, and an F chooses from lists
    expect(page.get_by_role("alert").filter(has_text="Not a serial: FB 8")).to_be_visible()
    expect(page.get_by_label("Robot serial")).to_have_value("FB-6")
    place.focus()
    scan(page, "FB-7", end="Tab")
    expect(page.get_by_label("Robot serial")).to_have_value("FB-7")
    expect(page.get_by_label("Operator")).to_have_value("ada")
    expect(page.get_by_label("Wanted accuracy")).to_have_value("")
    expect(page.get_by_label("Plan")).to_have_value("full")
    expect(page.locator(".report").filter(has_text="top")).to_be_hidden()
    expect(page.get_by_role("button", name="Calibrate")).to_be_focused()
    assert runs(station) == before
    assert refused(station)[0] == ("FB 8", "unknown")


def test_a_scan_in_another_view_leads_to_the_station(page: Page, station: Station) -> None:
    page.goto(f"{station.url}/history")
    expect(page.locator("header")).to_contain_text("connected")
    page.get_by_label("Robot serial").fill("FB-4")
    scan(page, "FB-7", delay=0)
    expect(page.get_by_role("button", name="Calibrate")).to_be_visible()
    expect(page.get_by_label("Robot serial")).to_have_value("FB-7")
    scan(page, "FB-8", delay=0)
    scan(page, "FB-9", delay=0)
    expect(page.get_by_label("Robot serial")).to_have_value("FB-9")


def test_slow_typing_of_the_same_characters_is_typing(page: Page, station: Station) -> None:
    open_station(page, station)
    page.get_by_label("Operator").focus()
    page.keyboard.type("BADGE:Bo", delay=60)
    expect(page.get_by_label("Operator")).to_have_value("BADGE:Bo")


def test_only_the_code_confirms_wherever_the_focus_is(page: Page, slow_station: Station) -> None:
    open_station(page, slow_station)
    before = runs(slow_station)
    for wrong in ("FB-7", "CONFIRM1", "BADGE:Ada", "confirm"):
        arm(page)
        scan(page, wrong)
        expect(page.get_by_role("button", name="Confirm")).to_be_hidden()
    assert runs(slow_station) == before
    arm(page)
    page.get_by_label("Operator").focus()
    scan(page, "CONFIRM")
    expect(page.get_by_role("button", name="Abort run")).to_be_enabled()
    assert runs(slow_station)[0]["robot_serial"] == "FB-7"
    assert runs(slow_station)[0]["operator"] == "ada"
    scan(page, "FB-8")  # the next robot may be prepared while this one is measured
    expect(page.get_by_label("Robot serial")).to_have_value("FB-8")
    expect(page.locator(".progress")).to_contain_text("FB-7")
    page.get_by_role("button", name="Abort run").click()
    expect(page.locator(".outcome")).to_contain_text("ABORTED")
    expect(page.get_by_role("button", name="Confirm")).to_be_hidden()


def test_half_a_second_does_not_confirm_and_more_than_one_does(page: Page, station: Station) -> None:
    open_station(page, station)
    arm(page, "FB-700")
    button = page.get_by_role("button", name="Confirm")
    button.click()
    button.click(delay=500)
    button.press("Enter")
    button.press("Space", delay=500)
    expect(button).to_be_visible()
    assert all(run["robot_serial"] != "FB-700" for run in runs(station))
    assert violations(page) == []
    button.click(delay=HOLD_MS)
    expect(page.locator(".outcome")).to_contain_text("FB-700")


def test_what_is_armed_counts_down_and_is_withdrawn(page: Page, station: Station) -> None:
    open_station(page, station)
    before = runs(station)
    button = page.get_by_role("button", name="Confirm")
    arm(page)
    page.keyboard.press("Escape")
    expect(button).to_be_hidden()
    arm(page)
    page.get_by_role("link", name="History", exact=True).click()
    page.get_by_role("link", name="Station", exact=True).click()
    expect(button).to_be_hidden()
    arm(page)
    page.evaluate("document.dispatchEvent(new Event('visibilitychange'))")
    expect(button).to_be_hidden()
    arm(page)
    group = page.get_by_role("group", name="Confirm: Calibrate")
    expect(group).to_contain_text("within 10 s")
    expect(group).to_contain_text("within 8 s")
    expect(button).to_be_hidden(timeout=12_000)
    scan(page, "CONFIRM")
    expect(page.get_by_role("alert").filter(has_text="Nothing waits")).to_be_visible()
    assert runs(station) == before


def test_a_badge_signs_on_with_its_pin(page: Page, serve: Serve, tmp_path: Any) -> None:
    (tmp_path / "station.toml").write_text("[service]\nopen = false\n")
    store = Store(tmp_path / "station.db")
    root = Actor(name="root", via="terminal")
    for name, badge in (("Ada", "BADGE:1"), ("Bo", "BADGE:2")):
        store.add_user(
            root,
            name,
            "operator",
            password_hash=hashed_password("correct horse"),
            badge_sha256=secret_hash(badge),
            pin_hash=hashed_pin("4711"),
        )
    store.close()
    station = serve(config=tmp_path / "station.toml")
    page.goto(station.url)
    expect(page.get_by_role("heading", name="Sign in")).to_be_visible()
    scan(page, "FB-7")
    expect(page.get_by_role("alert").filter(has_text="Sign in first")).to_be_visible()
    for name, badge in (("Ada", "BADGE:1"), ("Bo", "BADGE:2")):
        scan(page, badge)
        expect(page.get_by_label("PIN")).to_be_focused()
        page.keyboard.type("4711", delay=60)
        page.wait_for_timeout(60)
        page.keyboard.press("Enter")
        expect(page.locator(".who")).to_contain_text(f"Signed in: {name}")
        expect(page.get_by_label("Operator")).to_have_value(name)
    assert violations(page) == []
