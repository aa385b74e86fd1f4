"""From the scan to the result, with mouse, with keyboard alone, and after a restart."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.browser.conftest import Serve, Station
from tests.browser.steps import HOLD_MS, add_run, confirm, loaded, open_station, run_to_end, scan, start


def test_calibrate_confirm_result_and_history_after_a_restart(
    page: Page, serve: Serve, tmp_path: Path
) -> None:
    station = serve()
    open_station(page, station)
    run_to_end(page, "FB-100")
    expect(page.locator(".readings tbody tr").filter(has_text="within").first).to_be_visible()
    page.get_by_role("link", name="Result 1").click()
    expect(page.get_by_role("heading", name="Result of run 1")).to_be_visible()
    verdict = page.locator(".verdict").inner_text()
    page.get_by_text("Zero offsets, in °").click()
    offsets = page.locator("td.main").first.inner_text()
    assert "±" in offsets

    station.close()
    expect(page.locator("header")).to_contain_text("OFFLINE")
    serve(tmp_path)
    expect(page.locator("header")).to_contain_text("connected")
    page.get_by_role("link", name="History", exact=True).click()
    expect(page.locator("tbody tr")).to_have_count(1)
    page.get_by_role("link", name="1", exact=True).click()
    expect(page.locator(".verdict")).to_have_text(verdict, use_inner_text=True)
    page.get_by_text("Zero offsets, in °").click()
    expect(page.locator("td.main").first).to_have_text(offsets)


def test_a_run_by_keyboard_alone(page: Page, station: Station) -> None:
    open_station(page, station)
    for text in ("FB-200", "ada"):
        page.keyboard.type(text, delay=60)
        page.wait_for_timeout(60)
        page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="Calibrate")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="Confirm")).to_be_focused()
    page.keyboard.press("Enter", delay=HOLD_MS)
    expect(page.locator(".outcome")).to_contain_text("FB-200", timeout=60_000)


def test_the_last_result_stays_until_the_next_serial_is_scanned(page: Page, station: Station) -> None:
    open_station(page, station)
    run_to_end(page, "FB-300")
    page.get_by_label("Operator").fill("bob")
    loaded(page, page.reload)
    expect(page.locator(".outcome")).to_contain_text("FB-300")
    scan(page, "FB-301")
    expect(page.locator(".outcome")).to_be_hidden()


def test_a_refusal_is_shown_at_its_field(page: Page, station: Station) -> None:
    open_station(page, station)
    page.get_by_role("button", name="Calibrate").click()
    expect(page.get_by_role("alert").filter(has_text="serial")).to_be_visible()
    expect(page.get_by_label("Robot serial")).to_be_focused()
    page.get_by_label("Robot serial").fill("FB 1 %")
    page.get_by_label("Operator").fill("ada")
    page.get_by_role("button", name="Calibrate").click()
    confirm(page)
    expect(page.get_by_label("Robot serial")).to_have_attribute("aria-invalid", "true")


def test_filters_and_page_live_in_the_address(page: Page, station: Station) -> None:
    add_run(station, "FB-400")
    page.goto(f"{station.url}/history")
    page.get_by_label("Robot serial").fill("fb-40")
    page.wait_for_timeout(60)  # a scanner would be faster
    page.get_by_label("Robot serial").press("Enter")
    page.get_by_label("Verdict", exact=True).select_option("pass")
    expect(page).to_have_url(f"{station.url}/history?search=fb-40&verdict=pass")
    page.reload()
    expect(page.get_by_label("Robot serial")).to_have_value("fb-40")
    for cell in page.locator("tbody td.serial a.cell").all():
        expect(cell).to_have_text("FB-400")


def test_a_run_cut_off_shows_as_interrupted(page: Page, serve: Serve, tmp_path: Path) -> None:
    station = serve(speed=5)
    open_station(page, station)
    start(page, "FB-500")
    expect(page.locator(".readings tbody tr").first).to_be_visible()
    station.kill()
    serve(tmp_path)
    expect(page.locator(".outcome")).to_contain_text("INTERRUPTED")
    expect(page.get_by_role("button", name="Calibrate")).to_be_enabled()
    expect(page.get_by_role("button", name="Abort run")).to_be_disabled()


def test_what_is_typed_into_a_filter_outlives_what_the_station_tells(
    page: Page, slow_station: Station
) -> None:
    body = {"robot_serial": "FB-450", "plan": "paper", "operator": "ada"}
    page.goto(f"{slow_station.url}/history")
    page.get_by_label("Robot serial").fill("FB-4")
    run = slow_station.api.post("/calibrations", json=body).raise_for_status().json()["id"]
    expect(page.locator("tbody")).to_contain_text("FB-450")
    expect(page.get_by_label("Robot serial")).to_have_value("FB-4")
    slow_station.api.post(f"/calibrations/{run}/abort").raise_for_status()
    expect(page.locator("tbody")).to_contain_text("ABORTED")
    expect(page.get_by_label("Robot serial")).to_have_value("FB-4")
