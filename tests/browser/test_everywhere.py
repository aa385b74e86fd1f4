"""Every view at every size, on paper, for whoever comes late, and after the station was away."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Serve, Station
from tests.browser.steps import add_run, open_station, run_to_end, start, violations
from tests.browser.test_stopping import ON_TOP

SIDEWAYS = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
WATCH = """() => {
  window.seen = [];
  const limits = '.readings td:nth-child(5)';
  new MutationObserver(() => {
    if (document.querySelector('.progress').hidden) return;
    const judged = [...document.querySelectorAll(limits)].filter(cell => cell.textContent !== '–').length;
    window.seen.push([document.querySelector('progress').value, judged]);
  }).observe(document.querySelector('main'), {subtree: true, childList: true, attributes: true});
}"""
"""Notes how far the run is, and how many readings have a residual, at every change."""
PHONE, ZOOMED, WIDE = (390, 844), (640, 400), (1920, 1080)
"""The second is 1280x800 at 200 %."""


@pytest.fixture(scope="module")
def run(station: Station) -> int:
    found: dict[str, Any] = add_run(station, "FB-EVERYWHERE-WITH-A-LONG-SERIAL")
    return int(found["id"])


@pytest.mark.parametrize("size", [PHONE, ZOOMED, WIDE], ids=lambda size: f"{size[0]}x{size[1]}")
def test_stop_is_whole_and_nothing_scrolls_sideways(
    page: Page, station: Station, run: int, size: tuple[int, int]
) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    for path in ("/", f"/result/{run}", "/history", f"/diagnosis/{run}"):
        page.goto(f"{station.url}{path}")
        expect(page.locator("header")).to_contain_text("connected")
        expect(page.locator("main h1")).to_be_attached()
        for place in ("0", "document.body.scrollHeight"):
            page.evaluate(f"scrollTo(0, {place})")
            assert page.get_by_role("button", name="STOP").evaluate(ON_TOP), (path, place)
        assert page.evaluate(SIDEWAYS) <= 0, path
        assert size != PHONE or violations(page) == [], path


def test_charts_shrink_with_the_window(page: Page, station: Station, run: int) -> None:
    page.set_viewport_size({"width": 1920, "height": 1080})
    page.goto(f"{station.url}/result/{run}?open=residuals")
    chart = page.locator(".chart svg").first
    expect(chart).to_be_visible()
    page.set_viewport_size({"width": 1024, "height": 768})
    expect(chart).to_have_js_property(
        "clientWidth", page.locator(".chart").first.evaluate("e => e.clientWidth")
    )
    assert page.evaluate(SIDEWAYS) <= 0


def test_paper_has_neither_navigation_nor_stop(page: Page, station: Station, run: int) -> None:
    page.goto(f"{station.url}/result/{run}?open=residuals")
    expect(page.locator(".chart svg").first).to_be_visible()
    page.emulate_media(media="print")
    for name in ("STOP", "Apply to drives"):
        expect(page.get_by_role("button", name=name)).to_be_hidden()
    expect(page.get_by_role("navigation")).to_be_hidden()
    expect(page.locator(".verdict").first).to_be_visible()


def test_each_view_has_its_title_and_takes_the_focus(page: Page, station: Station, run: int) -> None:
    open_station(page, station)
    expect(page).to_have_title("Station – Calibration station")
    expect(page.get_by_label("Robot serial")).to_be_focused()
    for link, title in (("History", "History"), ("Result", "Result of run"), ("Station", "Station")):
        page.get_by_role("link", name=link, exact=True).first.click()
        expect(page.locator("main h1")).to_be_focused()
        expect(page.locator("main h1")).to_contain_text(title)
        assert page.title().startswith(title)


def test_who_comes_late_sees_the_run_under_way_and_the_last_one(
    page: Page, serve: Serve, tmp_path: Path
) -> None:
    station = serve(speed=20)
    open_station(page, station)
    start(page)
    rows = page.locator(".readings tbody tr")
    expect(rows.nth(2)).to_be_visible()
    late = page.context.new_page()
    open_station(late, station)
    expect(late.locator(".readings tbody tr").nth(2)).to_be_visible()
    expect(page.locator(".outcome")).to_contain_text("FB-7", timeout=30_000)
    shown = page.locator(".readings").inner_text()
    marks = page.locator(".map .done circle").count()
    late.reload()
    expect(late.locator(".readings")).to_have_text(shown, use_inner_text=True)
    station.close()
    serve(tmp_path)
    page.reload()
    expect(page.locator(".readings h2")).to_have_text(shown.splitlines()[0])
    assert page.locator(".map .done circle").count() >= marks > 6


def test_the_progress_never_falls_and_residuals_come_while_it_measures(page: Page, serve: Serve) -> None:
    station = serve(speed=50)
    open_station(page, station)
    page.evaluate(WATCH)
    run_to_end(page, plan="rapid")
    seen = [(part, judged) for part, judged in page.evaluate("window.seen") if part > 0]
    parts = [part for part, _ in seen]
    assert parts == sorted(parts)
    assert len(set(parts)) > 10
    assert max(judged for part, judged in seen if part < 0.9) >= 8


@pytest.mark.parametrize("path", ["/history", "/"])
def test_what_was_opened_while_the_station_was_away_comes_back(
    page: Page, serve: Serve, tmp_path: Path, path: str
) -> None:
    station = serve()
    add_run(station, "FB-9")
    open_station(page, station)
    station.kill()
    expect(page.locator("header")).to_contain_text("OFFLINE")
    if path == "/":
        expect(page.locator(".devices")).to_contain_text("not known")
        expect(page.locator(".devices").get_by_text("ok", exact=True)).to_have_count(0)
        page.get_by_role("button", name="STOP").click()
        expect(page.locator(".report")).to_contain_text("STOP FAILED")
    else:
        page.get_by_role("link", name="History" if path == "/history" else "Result", exact=True).first.click()
        expect(page.locator("main")).to_contain_text("does not respond")
    serve(tmp_path)
    expect(page.locator("header")).to_contain_text("connected")
    if path == "/":
        expect(page.locator(".devices").get_by_text("ok", exact=True).first).to_be_visible()
        expect(page.locator(".report")).not_to_contain_text("STOP FAILED")
        expect(page.locator(".report")).to_contain_text("was not confirmed")
    else:
        expect(page.locator("main")).to_contain_text("FB-9")


def test_the_recommended_plan_is_chosen(page: Page, station: Station) -> None:
    open_station(page, station)
    expect(page.get_by_label("Plan")).to_have_value(station.get("/station")["station"]["recommended_plan"])
