"""One step to stop, at any size, in any state, with any number of pages open."""

from __future__ import annotations

import pytest
from playwright.sync_api import BrowserContext, Page, ViewportSize, expect

from tests.browser.conftest import LARGE, SMALL, Station
from tests.browser.steps import add_run, arm, confirm, open_station, start, violations

ON_TOP = """button => {
  const box = button.getBoundingClientRect();
  const inside = box.left >= 0 && box.top >= 0 && box.right <= innerWidth && box.bottom <= innerHeight;
  const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
  return inside && box.height >= 64 && button.contains(top) && !button.disabled;
}"""
CUT_OFF = """() => [...document.querySelectorAll('body *')].filter(element => {
  // a wide table scrolls within its own region
  if (element.closest('.hidden, [hidden], svg, [role=region].scroll')) return false;
  const box = element.getBoundingClientRect();
  if (box.width && (box.left < -1 || box.right > document.documentElement.clientWidth + 1)) return true;
  return element.scrollWidth > element.clientWidth + 1 && getComputedStyle(element).overflowX !== 'visible';
}).map(element => `${element.tagName}.${element.className}: ${element.textContent.slice(0, 40)}`)"""


def check(page: Page) -> None:
    """Nothing is cut off, and stop is at hand at the top and at the bottom of the page."""
    assert page.evaluate(CUT_OFF) == []
    for place in ("0", "document.body.scrollHeight"):
        page.evaluate(f"scrollTo(0, {place})")
        assert page.get_by_role("button", name="STOP").evaluate(ON_TOP)


@pytest.mark.parametrize("size", [SMALL, LARGE], ids=["1024x768", "1280x800"])
def test_nothing_is_cut_off_and_stop_is_always_at_hand(
    page: Page, station: Station, size: ViewportSize
) -> None:
    add_run(station, "FB-600-A-LONG-SERIAL-0123456789")
    page.set_viewport_size(size)
    open_station(page, station)
    check(page)
    arm(page)
    check(page)
    page.keyboard.press("Escape")  # to look took time, and what is armed is withdrawn after ten seconds
    arm(page)
    confirm(page)
    expect(page.locator(".readings tbody tr").first).to_be_visible()
    check(page)
    expect(page.locator(".outcome")).to_be_visible()
    check(page)
    page.goto(f"{station.url}/result?open=offsets.accuracy.drives.residuals.memory.cause.run")
    expect(page.locator(".chart svg")).to_be_visible()
    expect(page.locator(".field-map")).to_have_count(2)
    check(page)
    page.goto(f"{station.url}/history")
    expect(page.locator("tbody tr").first).to_be_visible()
    check(page)
    page.goto(f"{station.url}/history?robot_serial=nobody")
    expect(page.locator(".empty")).to_have_text("No run matches.")
    check(page)
    page.get_by_role("button", name="STOP").click()
    expect(page.locator(".report")).to_contain_text("both drives confirmed")
    check(page)


def test_stop_ends_a_run_from_any_view(page: Page, slow_station: Station) -> None:
    open_station(page, slow_station)
    start(page)
    page.get_by_role("link", name="History", exact=True).click()
    page.get_by_role("button", name="STOP").click()
    expect(page.locator("tbody tr").first).to_contain_text("ABORTED")


def test_abort_is_sent_with_six_pages_open(context: BrowserContext, slow_station: Station) -> None:
    pages = [context.new_page() for _ in range(6)]
    for page in pages:
        open_station(page, slow_station)
    start(pages[0])
    expect(pages[5].get_by_role("button", name="Abort run")).to_be_enabled()
    pages[5].get_by_role("button", name="Abort run").click()
    for page in pages:
        expect(page.locator(".outcome")).to_contain_text("ABORTED")


def test_a_press_of_half_a_second_counts_while_values_change(page: Page, slow_station: Station) -> None:
    open_station(page, slow_station)
    buttons = "window.kept = [...document.querySelectorAll('button')]"
    page.evaluate(buttons)
    start(page)
    page.get_by_role("button", name="Abort run").click(delay=500)
    expect(page.locator(".outcome")).to_contain_text("ABORTED")
    assert page.evaluate("window.kept.every(button => button.isConnected)")
    assert page.evaluate("document.activeElement !== document.body")


def test_a_frozen_server_shows_as_offline_and_stop_says_that_it_failed(page: Page, station: Station) -> None:
    open_station(page, station)
    arm(page)
    station.freeze()
    expect(page.locator("header")).to_contain_text("OFFLINE", timeout=5_000)
    expect(page.locator("header")).to_contain_text("values may be old")
    for name in ("Calibrate", "Abort run"):
        expect(page.get_by_role("button", name=name)).to_be_disabled()
    expect(page.get_by_role("button", name="Confirm")).to_be_hidden()
    page.get_by_role("button", name="STOP").click()
    expect(page.locator(".report")).to_contain_text("STOP FAILED")
    expect(page.locator(".report")).to_contain_text("emergency stop")
    assert violations(page) == []
    check(page)
    station.thaw()
    expect(page.locator("header")).to_contain_text("connected")
    expect(page.get_by_role("button", name="Calibrate")).to_be_enabled()
