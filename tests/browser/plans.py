"""Every plan carried out at the page on the emulated rig, as by an operator, with a picture of each step.

python -m tests.browser.plans docs/how-to/plans
"""

from __future__ import annotations

import re
import shutil
import sys
import time
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image
from playwright.sync_api import Page, expect, sync_playwright

from tests.browser.conftest import FLAGS, LARGE, Station
from tests.browser.steps import confirm, open_station

RUN_LIMIT_MS = 180_000
COLOURS = 24
"""Colours of a picture: the page has few."""
COLLISION = [{"device": "axis1", "kind": "lost_counts"}]
TYPE = "FB-375"
TAUGHT = "pick,10.5,170.25\nplace,-8.0,181.5\n"


class Operator:
    """An operator at the page; `steps` are the pictures, in order."""

    def __init__(self, page: Page, station: Station, folder: Path) -> None:
        self.page, self.station, self._folder = page, station, folder
        self.steps: list[str] = []

    def picture(self, name: str) -> None:
        """As small as readable: half of the size, few colours."""
        png = self.page.screenshot(full_page=False, animations="disabled", caret="hide")
        whole = Image.open(BytesIO(png)).convert("RGB")
        small = whole.resize((whole.width * 3 // 4, whole.height * 3 // 4), Image.Resampling.LANCZOS)
        small.quantize(COLOURS).save(self._folder / f"{name}.png", optimize=True)
        self.steps.append(name)
        print(name, flush=True)

    def start(self, serial: str, plan: str, accuracy: str = "") -> None:
        """Everything up to the robot's motion."""
        page = self.page
        page.locator("nav").get_by_role("link", name="Station").click()
        page.get_by_label("Robot serial").fill(serial)
        page.get_by_label("Operator").fill("ada")
        page.get_by_label("Wanted accuracy, mm").fill(accuracy)
        page.get_by_label("Plan", exact=True).select_option(plan)
        page.get_by_role("button", name="Calibrate", exact=True).click()
        confirm(page, page.locator(".start"))

    def end(self) -> int:
        """Wait for the end, and open the result; returns the number of the run."""
        page = self.page
        expect(page.locator(".outcome")).to_be_visible(timeout=RUN_LIMIT_MS)
        page.locator(".outcome").get_by_role("link").click()
        expect(page.locator(".decision")).to_be_visible()
        found = re.search(r"/result/(\d+)", page.url)
        assert found, page.url
        return int(found[1])

    def run(self, serial: str, plan: str, accuracy: str = "") -> int:
        self.start(serial, plan, accuracy)
        return self.end()

    def answer(self, value: str | None) -> None:
        """Answer the prompt of the run, with a number or by confirming."""
        page = self.page
        if value is not None:
            page.locator("#answer").fill(value)
        page.locator(".prompt .confirmed > button").click()
        confirm(page, page.locator(".prompt"))

    def asked(self, words: str) -> str:
        said = self.page.locator(".prompt strong").first
        expect(said).to_contain_text(words, timeout=RUN_LIMIT_MS)
        return said.inner_text()

    def press_next(self, name: str) -> None:
        """Press the recommended next step of the result."""
        step = self.page.get_by_role("region", name="Next step")
        step.get_by_role("button", name=name).click()
        confirm(self.page, step)


def calibrated_and_applied(operator: Operator) -> None:
    page = operator.page
    operator.run("FB-7", "full")
    expect(page.locator(".maps figure")).to_have_count(2)
    operator.picture("full")
    operator.press_next("Apply to drives")
    expect(page.locator(".summary").first).to_contain_text("Verified.", timeout=RUN_LIMIT_MS)


def translated(operator: Operator) -> None:
    page = operator.page
    fold = page.get_by_role("group", name="Taught positions")
    fold.locator("summary").click()
    fold.get_by_label("Positions").fill(TAUGHT)
    fold.get_by_role("button", name="Translate").click()
    expect(fold.locator("tbody tr")).to_have_count(2)
    fold.scroll_into_view_if_needed()
    operator.picture("translate")


def checked(operator: Operator) -> None:
    page, api = operator.page, operator.station.api
    operator.run("FB-7", "check")
    expect(page.locator(".decision")).to_contain_text("GOOD")
    operator.picture("check")
    api.put("/emulator/faults", json=COLLISION).raise_for_status()
    operator.run("FB-7", "check")
    expect(page.locator(".decision")).not_to_contain_text("GOOD")
    operator.picture("check-failed")
    page.locator("nav").get_by_role("link", name="Station").click()
    expect(page.get_by_text("Locked: check")).to_be_visible()
    operator.picture("locked")


def adapted(operator: Operator) -> None:
    page = operator.page
    operator.run("FB-7", "adaptive", "1.2")
    expect(page.locator(".decision")).to_contain_text("GOOD")
    expect(page.locator(".maps figure")).to_have_count(2)
    operator.picture("adaptive")
    page.locator("nav").get_by_role("link", name="Station").click()
    expect(page.get_by_text("Locked: check")).to_be_hidden()


def advised(operator: Operator) -> None:
    page = operator.page
    operator.run("FB-8", "rapid", "0.3")
    expect(page.get_by_role("region", name="Next step")).to_contain_text("The bound falls by")
    page.get_by_role("group", name="Promised accuracy").locator("summary").click()
    page.get_by_text("What would raise the accuracy").scroll_into_view_if_needed()
    operator.picture("advice")


def referenced(operator: Operator, run: int) -> None:
    zeros = operator.station.get(f"/calibrations/{run}")["zero_offsets"]
    operator.start("FB-7", "reference")
    said = operator.asked("Put the level")
    operator.picture("reference")
    drive = re.search(r"says ([−\d.-]+)°", said)
    assert drive, said
    # the emulated arm has no level: the value comes from the previous run
    level = float(drive[1].replace("−", "-")) + zeros[0]["value_deg"]
    operator.answer(f"{level:.3f}")
    operator.end()
    expect(operator.page.locator(".maps figure")).to_have_count(2)
    operator.picture("reference-result")


def mounted_twice(operator: Operator) -> None:
    operator.start("FB-7", "two_mounts")
    operator.asked("second mounting point")
    operator.picture("two-mounts")
    operator.answer(None)
    operator.asked("back at its first")
    operator.answer(None)
    operator.end()
    expect(operator.page.locator(".maps figure")).to_have_count(2)
    operator.picture("two-mounts-result")


def taught_by_a_fleet(operator: Operator) -> None:
    station, page = operator.station, operator.page
    sections = station.get("/robots/FB-7")["file"]
    for number in range(1, 4):
        serial = f"FB-2{number}"
        sections["robot"] |= {"serial": serial, "type": TYPE}
        station.api.put(f"/robots/{serial}", json=sections).raise_for_status()
        operator.run(serial, "rapid")
    expect(page.locator(".maps figure")).to_have_count(2)
    page.get_by_text("Stored parameters").first.click()
    expect(page.locator(".memory")).to_contain_text("starts from run")
    page.get_by_text(f"type {TYPE}").first.scroll_into_view_if_needed()
    operator.picture("fleet")


def walk(page: Page, station: Station, folder: Path) -> list[str]:
    """All plans in sequence, each on the machine as the previous one left it."""
    operator = Operator(page, station, folder)
    open_station(page, station)
    calibrated_and_applied(operator)
    translated(operator)
    checked(operator)
    adapted(operator)
    run = operator.run("FB-7", "full")
    referenced(operator, run)
    mounted_twice(operator)
    advised(operator)
    taught_by_a_fleet(operator)
    return operator.steps


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    begun = time.monotonic()
    with TemporaryDirectory() as home, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        page = browser.new_page(viewport=LARGE)  # type: ignore[arg-type]
        page.set_default_timeout(60_000)
        expect.set_options(timeout=30_000)
        station = Station(Path(home), speed=1000.0)
        try:
            steps = walk(page, station, folder)
        finally:
            station.close()
            browser.close()
    print(f"{len(steps)} pictures in {folder}, {time.monotonic() - begun:.0f} s")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
