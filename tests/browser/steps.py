"""An operator's actions at the page, in words."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from playwright.sync_api import Locator, Page, expect

from tests.browser.conftest import ROOT, Station, needed

AXE = ROOT / "web/ui/node_modules/axe-core/axe.min.js"
AXE_RUN = """() => axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa']})
  .then(found => found.violations.map(v => `${v.id}: ${v.nodes.map(n => n.html).join(' | ')}`))"""


def open_station(page: Page, station: Station) -> None:
    loaded(page, lambda: page.goto(station.url))
    expect(page.locator("header")).to_contain_text("connected")


def loaded(page: Page, load: Callable[[], object]) -> None:
    """Wait until the page has the user and the patterns of the codes, which may be after it shows READY."""
    with page.expect_response("**/api/v1/scans"), page.expect_response("**/api/v1/session"):
        load()


SCANNER_MS = 5
"""Time from one key of a scanner to the next."""
CODES = {"Enter": 13, "Tab": 9}
HOLD_MS = 1200
"""Longer than a confirming button has to be held."""


def scan(page: Page, code: str, *, end: str = "Enter", delay: float = SCANNER_MS) -> None:
    """Send keys like a barcode scanner: key after key, then Enter, to the focused element.

    Each event has the time at which the scanner sends it, however loaded this computer is.
    """
    keys = page.context.new_cdp_session(page)
    at_s = time.time()
    for key in (*code, end):
        text = "\r" if key == "Enter" else key if len(key) == 1 else ""
        down = {"key": key, "windowsVirtualKeyCode": CODES.get(key, 0), "text": text}
        keys.send("Input.dispatchKeyEvent", {"type": "keyDown", "timestamp": at_s, **down})
        keys.send("Input.dispatchKeyEvent", {"type": "keyUp", "timestamp": at_s + 0.001, "key": key})
        at_s += delay / 1e3
    keys.detach()


def confirm(page: Page, within: Locator | None = None) -> None:
    """Hold the button that confirms, as with a glove."""
    (within or page).get_by_role("button", name="Confirm").click(delay=HOLD_MS)


def arm(page: Page, serial: str = "FB-7", plan: str = "paper") -> None:
    """All steps up to the confirmation."""
    page.get_by_label("Robot serial").fill(serial)
    page.get_by_label("Plan").select_option(plan)
    page.get_by_label("Operator").fill("ada")
    page.get_by_role("button", name="Calibrate").click()


def start(page: Page, serial: str = "FB-7", plan: str = "paper") -> None:
    arm(page, serial, plan)
    confirm(page)
    expect(page.get_by_role("button", name="Abort run")).to_be_enabled()


def run_to_end(page: Page, serial: str = "FB-7", plan: str = "paper") -> None:
    start(page, serial, plan)
    expect(page.locator(".outcome")).to_contain_text(serial, timeout=15_000)


def add_run(station: Station, serial: str = "FB-7") -> dict[str, Any]:
    """A complete run, started as the MES does."""
    return station.complete(robot_serial=serial, plan="paper")


def violations(page: Page) -> Any:
    """Findings of axe against WCAG 2.2 AA, each with the elements."""
    needed(AXE.is_file(), "axe-core (npm ci in web/ui)")
    page.evaluate(AXE.read_text())
    return page.evaluate(AXE_RUN)
