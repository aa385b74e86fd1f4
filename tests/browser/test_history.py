"""The line engineer's tool: found, counted, compared, drawn; all of it in the address."""

from __future__ import annotations

import csv
import io
import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Station
from tests.browser.steps import add_run, violations


@pytest.fixture(scope="module")
def runs(station: Station) -> list[int]:
    """Three of one robot, one of another."""
    return [int(add_run(station, serial)["id"]) for serial in ("HIST-1", "HIST-1", "HIST-1", "HIST-2")]


def test_a_list_is_found_counted_and_taken_away(page: Page, station: Station, runs: list[int]) -> None:
    page.goto(f"{station.url}/history")
    page.get_by_label("Robot serial").fill("hist-")
    page.get_by_label("Work order").focus()
    expect(page).to_have_url(re.compile("search=hist-$"))
    expect(page.get_by_text("4 runs", exact=True)).to_be_visible()
    page.get_by_role("button", name="Robot").click()
    expect(page).to_have_url(re.compile("order=serial$"))
    expect(page.get_by_role("columnheader", name="Robot")).to_have_attribute("aria-sort", "ascending")
    expect(page.locator("tbody tr").last).to_contain_text("HIST-2")
    page.get_by_role("button", name="Run", exact=True).click()
    expect(page).to_have_url(re.compile("order=oldest$"))
    expect(page.locator("tbody tr").first).to_contain_text("HIST-1")
    expect(page.get_by_label("Robot serial")).to_have_value("hist-")
    with page.expect_download() as download:
        page.get_by_role("link", name="List (CSV)").click()
    table = csv.DictReader(io.StringIO(download.value.path().read_text()))
    assert [int(row["id"]) for row in table] == runs
    page.get_by_role("link", name=str(runs[0]), exact=True).click()
    expect(page.locator("main h1")).to_contain_text(f"run {runs[0]}")
    page.go_back()
    expect(page.get_by_text("4 runs", exact=True)).to_be_visible()


def test_two_runs_are_compared_by_their_address(page: Page, station: Station, runs: list[int]) -> None:
    page.goto(f"{station.url}/history?search=hist-1")
    for run in runs[:2]:
        page.get_by_role("button", name=f"Compare run {run}", exact=True).click()
    compared = page.get_by_role("region", name="Two runs compared").first
    row = compared.get_by_role("row", name=re.compile("^Offset 1"))
    expect(compared.locator(".chart svg")).to_have_count(2)
    expect(row).to_contain_text("±")
    assert violations(page) == []
    page.reload()
    expect(row).to_contain_text("±")
    first, second, difference = (
        float(re.sub("\u2212", "-", text).split(" ±")[0]) for text in row.locator("td").all_inner_texts()
    )
    assert difference == pytest.approx(second - first, abs=2e-4)
    compared.get_by_role("button", name="End comparison").click()
    expect(page).to_have_url(f"{station.url}/history?search=hist-1")


def test_the_process_of_a_robot_is_drawn(page: Page, station: Station, runs: list[int]) -> None:
    page.goto(f"{station.url}/history?search=hist-1")
    page.locator("tbody").get_by_role("link", name="HIST-1").first.click()
    process = page.get_by_role("region", name="Process")
    expect(process.locator(".chart svg")).to_have_count(3)
    expect(process.get_by_role("heading")).to_have_text("Process: robot HIST-1")
    expect(process.locator(".pareto")).to_contain_text("newest 3 calibrations")
    assert violations(page) == []


def test_one_comes_back_to_where_the_list_was(page: Page, station: Station, runs: list[int]) -> None:
    page.set_viewport_size({"width": 1024, "height": 500})
    page.goto(f"{station.url}/history?search=hist&show=process")
    link = page.get_by_role("link", name=str(runs[0]), exact=True)
    link.scroll_into_view_if_needed()
    expect(page.locator(".process .chart svg").first).to_be_visible()
    link.scroll_into_view_if_needed()
    before = page.evaluate("scrollY")
    assert before > 100
    link.click()
    expect(page.locator("main h1")).to_contain_text("Result of run")
    page.go_back()
    expect(link).to_be_visible()
    page.wait_for_function("wanted => Math.abs(scrollY - wanted) < 40", arg=before)
