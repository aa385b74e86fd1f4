"""The maintenance page and the training desk, as an engineer uses them."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Station
from tests.browser.steps import add_run, confirm, violations

PARTS = ("Devices", "Wire log", "Deliveries", "Backups", "Users and keys", "Audit", "Versions", "Training")


def open_part(page: Page, station: Station, part: str) -> None:
    page.goto(f"{station.url}/maintenance")
    page.get_by_role("link", name=part, exact=True).click()
    expect(page.locator("header")).to_contain_text("connected")


def test_every_part_is_reached_and_accessible(page: Page, station: Station) -> None:
    add_run(station, "FB-900")
    for part in PARTS:
        open_part(page, station, part)
        expect(page.locator(".maintenance section h2").first).to_be_visible()
        expect(page.locator(".maintenance")).not_to_contain_text("Loading")
        assert violations(page) == [], part


def test_devices_are_examined_and_the_wire_log_is_read(page: Page, station: Station) -> None:
    run = add_run(station, "FB-901")
    open_part(page, station, "Devices")
    expect(page.get_by_role("row", name="linear scale")).to_contain_text("ND281B")
    page.get_by_role("button", name="Examine the devices").click()
    expect(page.get_by_text("No trouble was found.")).to_be_visible()
    expect(page.locator(".findings")).to_contain_text("stands at")
    open_part(page, station, "Wire log")
    page.get_by_label("Run", exact=True).fill(str(run["id"]))
    page.get_by_role("button", name="Show").click()
    expect(page.get_by_text("Asked drive 1 for its position").first).to_be_visible()
    page.get_by_role("button", name="Later").click()
    expect(page).to_have_url(f"{station.url}/maintenance?part=wire&run={run['id']}&cursor=100")


def test_a_restore_is_practised(page: Page, station: Station) -> None:
    open_part(page, station, "Backups")
    page.get_by_role("button", name="Practise a restore").click()
    expect(page.get_by_text("The backup can replace the history")).to_be_visible()
    expect(page.get_by_text("stop the service and enter: station restore")).to_be_visible()
    assert violations(page) == []


def test_a_user_and_a_key_are_made_and_ended(page: Page, station: Station) -> None:
    open_part(page, station, "Users and keys")
    users = page.locator("section", has=page.get_by_role("heading", name="Users"))
    users.get_by_label("Name").fill("Cleo")
    users.get_by_label("Password, 8 characters or more", exact=True).fill("correct horse")
    users.get_by_label("Role", exact=True).select_option("engineer")
    users.get_by_role("button", name="Add the user").click()
    row = users.get_by_role("row", name="Cleo")
    users.get_by_label("User", exact=True).select_option("Cleo")
    users.get_by_label("Text of the new badge").fill("BADGE:9")
    users.get_by_label("New PIN").fill("4711")
    users.get_by_role("button", name="Save the new sign-in").click()
    expect(users.get_by_text("The new sign-in of Cleo is saved.")).to_be_visible()
    expect(row.get_by_role("cell", name="yes", exact=True)).to_be_visible()
    assert violations(page) == []
    by_badge = station.api.post("/session", json={"badge": "BADGE:9", "pin": "4711"})
    assert by_badge.json()["name"] == "Cleo"
    station.api.cookies.clear()
    row.get_by_role("button", name="Disable Cleo", exact=True).click()
    confirm(page, row)
    expect(row).to_contain_text("disabled")
    keys = page.locator("section", has=page.get_by_role("heading", name="Keys of programs"))
    keys.get_by_label("Name").fill("line 9")
    keys.get_by_role("button", name="Make a key").click()
    key = keys.locator("code").inner_text()
    assert key.startswith("fbs_")
    assert violations(page) == []
    keys.get_by_role("row", name="line 9").get_by_role("button", name="Revoke line 9", exact=True).click()
    confirm(page, keys.get_by_role("row", name="line 9"))
    expect(keys.get_by_role("row", name="line 9")).to_contain_text("revoked")
    page.reload()
    expect(page.get_by_role("row", name="line 9")).to_be_visible()
    expect(page.locator("body")).not_to_contain_text(key)
    open_part(page, station, "Audit")
    page.get_by_label("Show entries that contain").fill("key.revoked")
    expect(page.locator("tbody tr").first).to_contain_text("key.revoked")


@pytest.mark.parametrize("part", ["Users and keys", "Audit"])
def test_what_a_role_may_not_do_is_said(page: Page, station: Station, part: str) -> None:
    name = f"eye {part}"
    key = station.api.post("/keys", json={"name": name, "role": "viewer"}).raise_for_status().json()["key"]
    page.set_extra_http_headers({"Authorization": f"Bearer {key}"})
    open_part(page, station, part)
    expect(page.get_by_text("Needs the role administrator. Your role is viewer.")).to_be_visible()
    assert violations(page) == []


def test_an_unseen_effect_is_found_revealed_and_repaired(page: Page, station: Station) -> None:
    station.api.post("/emulator/training/repair").raise_for_status()
    open_part(page, station, "Training")
    expect(page.get_by_text("Nothing is wrong with the machine.")).to_be_visible()
    page.get_by_role("button", name="Surprise me").click()
    expect(page.get_by_text("Find out what it is.")).to_be_visible()
    assert violations(page) == []
    page.get_by_role("button", name="Show what it is").click()
    expect(page.get_by_text("Find out what it is.")).to_be_hidden()
    page.get_by_label("What is wrong").select_option("scale silent")
    page.get_by_role("button", name="Begin").click()
    expect(page.locator(".pairs")).to_contain_text("Silent scale")
    page.get_by_label("Operator").fill("ada")
    page.get_by_role("button", name="Run the diagnosis", exact=True).click()
    confirm(page)
    expect(page.locator(".pairs")).to_contain_text("✓ found", timeout=60_000)
    assert violations(page) == []
    page.get_by_role("button", name="Repaired").click()
    expect(page.get_by_text("Nothing is wrong with the machine.")).to_be_visible()
    expect(page.get_by_role("row", name="Silent scale")).to_contain_text("✓ found")
    assert station.get("/emulator/faults") == []
