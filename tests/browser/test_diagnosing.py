"""The closed loop at the page: a run, its cause found by a walk, or said to be unexplained."""

from __future__ import annotations

import re

from playwright.sync_api import Page, expect

from tests.browser.conftest import ROOT, Serve, Station
from tests.browser.steps import add_run, violations

RIGS = ROOT / "drivers/emulated/rigs"
FAST = 1000.0
WALK_LIMIT_MS = 120_000
MARK = "button => button.dataset.mine = 'yes'"


def find_cause(page: Page, station: Station, *, serial: str = "FB-D") -> None:
    """From the result of a calibration to the walk under way."""
    page.goto(f"{station.url}/result/{add_run(station, serial)['id']}")
    cause = page.get_by_role("region", name="Cause", exact=True)
    button = cause.get_by_role("button", name="Find the cause", exact=True)
    expect(button).to_be_disabled()
    cause.get_by_label("Operator").fill("ada")
    button.click()
    cause.get_by_role("button", name="Confirm").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Result of run 2")


def test_an_undeclared_backlash_is_named_and_confirmed(page: Page, serve: Serve) -> None:
    station = serve(speed=FAST, rig=RIGS / "backlash.toml")
    find_cause(page, station)
    stop = page.get_by_role("button", name="STOP")
    stop.evaluate(MARK)
    causes = page.get_by_role("region", name="Causes")
    expect(causes).to_be_visible(timeout=WALK_LIMIT_MS)
    verdict = page.locator(".summary .verdict")
    expect(verdict).to_contain_text("PASS")
    expect(verdict).to_contain_text("backlash of joint 2 explains")
    expect(verdict).to_contain_text("predicts fresh readings")
    expect(causes).to_contain_text(re.compile(r"width 0\.0(49|50)\d* ± 0\.0000\d+ deg"))
    expect(causes).to_contain_text("Adjust or replace the reducer")
    expect(page.get_by_role("region", name="Errors").get_by_role("row")).to_have_count(4)
    assert stop.get_attribute("data-mine") == "yes"
    assert violations(page) == []
    page.get_by_role("link", name="Report").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Diagnosis of run 2, robot FB-D")


def test_what_no_effect_accounts_for_is_said_to_be_unexplained(page: Page, serve: Serve) -> None:
    station = serve(speed=FAST, rig=RIGS / "unexplained.toml")
    find_cause(page, station)
    expect(page.get_by_role("region", name="Hints")).to_be_visible(timeout=WALK_LIMIT_MS)
    verdict = page.locator(".summary .verdict")
    expect(verdict).to_contain_text("FAIL")
    expect(verdict).to_contain_text(re.compile(r"(un|not )explained: .*the residual depends on"))
    expect(page.get_by_role("region", name="Causes")).not_to_contain_text("What to do")
    assert violations(page) == []


def test_stop_ends_the_walk_that_looks_for_a_cause(page: Page, slow_station: Station) -> None:
    body = {"robot_serial": "FB-E", "plan": "diagnostic", "operator": "ada"}
    run = slow_station.api.post("/calibrations", json=body).raise_for_status().json()["id"]
    page.goto(f"{slow_station.url}/result/{run}")
    expect(page.locator(".summary .verdict")).to_contain_text("RUNNING")
    page.get_by_role("button", name="STOP").click()
    expect(page.locator(".summary .verdict")).to_contain_text("ABORTED")
