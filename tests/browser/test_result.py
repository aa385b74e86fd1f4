"""The result at the page: the decision, the maps, the folds, at every size."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Station
from tests.browser.steps import violations

MOST_BYTES = 250_000


def calibrated(station: Station, **more: object) -> int:
    """A complete run of plan `full` with a wanted accuracy, as the MES asks for it."""
    return int(station.complete(**{"robot_serial": "FB-R", "plan": "rapid", **more})["id"])


@pytest.mark.parametrize(
    ("wanted", "decision"),
    [
        (9.0, r"GOOD: position error at most \d\.\d{3} mm \(95 %\), limit 9\.000 mm"),
        (0.1, r"NOT ACCURATE ENOUGH: position error at most \d\.\d{3} mm \(95 %\), limit 0\.100 mm"),
        (None, r"GOOD: position error at most \d\.\d{3} mm \(95 %\), no limit was given"),
    ],
)
def test_one_line_decides_and_one_button_goes_on(
    page: Page, station: Station, wanted: float | None, decision: str
) -> None:
    run = calibrated(station, robot_serial="FB-W", accuracy_mm=wanted)
    bound = station.get(f"/calibrations/{run}")["accuracy"]["bound_95_mm"]
    page.goto(f"{station.url}/result/{run}")
    # values do not break before their units
    expect(page.locator(".decision")).to_have_text(re.compile(decision.replace(" ", r"\s")))
    expect(page.locator(".decision")).to_contain_text(f"{bound:.3f}")
    step = page.get_by_role("region", name="Next step")
    assert step.get_by_role("button").or_(step.get_by_role("link")).count() == 1
    expect(page.locator(".field-map")).to_have_count(2)
    page.get_by_text("Zero offsets, in °").click()
    valid = bound <= wanted if wanted else True
    expect(page.locator("table").first).to_contain_text("within" if valid else "not valid")
    if not valid:
        expect(page.locator("main")).not_to_contain_text("within")
    assert violations(page) == []


def test_the_maps_are_read_by_key_and_by_tap(page: Page, station: Station) -> None:
    run = calibrated(station, accuracy_mm=1.0)
    found = station.get(f"/calibrations/{run}/error-map")
    page.goto(f"{station.url}/result/{run}")
    maps = page.get_by_role("region", name="Position error over the workspace")
    value = maps.locator("output")
    expect(value).to_contain_text(f"after at most {found['bound_95_mm']:.3f} mm (95 %)")
    maps.get_by_role("application").focus()
    for _ in range(40):
        page.keyboard.press("ArrowLeft")
        page.keyboard.press("ArrowUp")
    expect(value).to_contain_text(
        f"x −240 mm, y −632 mm: before {found['before_mm'][-1][0]:.3f} mm; "
        f"after at most {found['after_95_mm'][-1][0]:.3f} mm (95 %), "
        f"expected {found['after_mm'][-1][0]:.3f} mm"
    )
    maps.locator(".field-map .area").last.click(force=True)
    expect(value).to_contain_text(re.compile(r"^x -?0 mm, y −7\d\d mm"))
    expect(maps.locator("circle")).to_have_count(len(found["fresh"]))
    flat = [value for row in found["after_95_mm"] for value in row]
    crossed = min(flat) < found["limit_mm"] < max(flat)
    expect(maps.locator("figure").last.locator("path.limit")).to_have_count(2 if crossed else 0)
    assert violations(page) == []


def test_what_is_open_is_in_the_address_and_opens_by_key(page: Page, station: Station) -> None:
    run = calibrated(station)
    sizes: list[int] = []
    page.on("response", lambda answer: sizes.append(len(answer.body()) if answer.ok else 0))
    page.goto(f"{station.url}/result/{run}")
    expect(page.locator(".field-map")).to_have_count(2)
    # charts of folds come when they are opened
    assert 0 < sum(sizes) < MOST_BYTES
    fold = page.get_by_role("group", name="Zero offsets, in °")
    fold.locator("summary").focus()
    page.keyboard.press("Enter")
    expect(fold.locator("table").first).to_be_visible()
    expect(page).to_have_url(re.compile(r"\?open=offsets$"))
    page.reload()
    expect(fold.locator("table").first).to_be_visible()
    fold.locator("summary").focus()
    page.keyboard.press("Space")
    expect(page).to_have_url(re.compile(rf"/result/{run}$"))


def test_nothing_of_a_result_is_wider_than_the_window(page: Page, station: Station) -> None:
    run = calibrated(station, accuracy_mm=1.0)
    page.goto(f"{station.url}/result/{run}?open=offsets.accuracy.drives.memory.cause.run")
    expect(page.locator(".field-map")).to_have_count(2)
    for width, height in ((390, 844), (1024, 768), (1280, 800), (1920, 1080)):
        page.set_viewport_size({"width": width, "height": height})
        wide = page.evaluate(
            """() => [...document.querySelectorAll('main *')]
              .filter(e => !e.closest('.folded') && e.getBoundingClientRect().right > innerWidth + 1)
              .map(e => e.outerHTML.slice(0, 80))"""
        )
        assert wide == [], width
