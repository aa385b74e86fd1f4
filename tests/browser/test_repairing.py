"""From a broken machine to a good certificate, as the operator goes: one next step after the other."""

from __future__ import annotations

import json
import re
from io import BytesIO

import pytest
from playwright.sync_api import Page, expect
from pypdf import PdfReader

from tests.browser.conftest import Serve
from tests.browser.steps import confirm, open_station, scan

RUN_LIMIT_MS = 90_000
PLAY = {"kind": "backlash", "joint": 2, "size": 0.1}


def shown_run(page: Page) -> int:
    """The run whose result is open."""
    found = re.search(r"/result/(\d+)", page.url)
    assert found, page.url
    return int(found[1])


def next_step(page: Page, button: str) -> None:
    """Press what the result recommends, and confirm it."""
    step = page.get_by_role("region", name="Next step")
    step.get_by_role("button", name=button).click()
    confirm(page, step)


@pytest.mark.timeout(300)
def test_scan_repair_calibrate_apply_and_certify(page: Page, serve: Serve) -> None:
    station = serve(speed=1000.0)
    station.api.post("/emulator/training", json=PLAY).raise_for_status()
    open_station(page, station)
    scan(page, "FB-9")
    expect(page.get_by_label("Robot serial")).to_have_value("FB-9")
    page.get_by_label("Operator").fill("ada")
    page.get_by_label("Plan").select_option("diagnostic")
    page.get_by_role("button", name="Calibrate").click()
    confirm(page)
    # the cause, by its name and size
    expect(page.locator(".outcome")).to_contain_text("REPAIR", timeout=RUN_LIMIT_MS)
    page.get_by_role("link", name="Result").first.click()
    expect(page.locator(".decision")).to_have_text(
        re.compile(r"REPAIR:\sBacklash of joint 2, 0\.(09|10|11)"), timeout=RUN_LIMIT_MS
    )
    # somebody takes the play out of the reducer
    station.api.post("/emulator/training/repair").raise_for_status()
    next_step(page, "Repaired: measure again")
    expect(page.locator(".decision")).to_contain_text("GOOD", timeout=RUN_LIMIT_MS)
    expect(page.get_by_role("button", name="Apply to drives")).to_be_visible(timeout=RUN_LIMIT_MS)
    expect(page.locator(".decision")).to_contain_text("GOOD: position error at most")
    run = shown_run(page)
    next_step(page, "Apply to drives")
    expect(page.get_by_text("The drives hold these zero offsets.").first).to_be_visible(timeout=RUN_LIMIT_MS)
    # the certificate says what is on record
    address = page.locator("a[href*='certificate.pdf']").get_attribute("href")
    assert address is not None and f"/{run}/" in address
    pdf = PdfReader(BytesIO(page.request.get(f"{station.url}{address}").body()))
    text = re.sub(r"\s", "", pdf.pages[0].extract_text())
    record = station.get(f"/calibrations/{run}")
    for zero in record["zero_offsets"]:
        stated = re.search(rf"joint{zero['joint']}([\u2212\d.]+)±([\d.]+)", text)
        assert stated, text
        digits = len(stated[1].partition(".")[2])
        value = f"{zero['value_deg']:.{digits}f}".replace("-", "\u2212")
        assert (stated[1], stated[2]) == (value, f"{2 * zero['sd_deg']:.{digits}f}")
    assert f"{record['accuracy']['bound_95_mm']:.3f}mm" in text
    attached = json.loads(pdf.attachments["certificate.json"][0])["certificate"]
    assert attached["zeros_in_drives"]["verified"] is True
    assert attached["statement"]["verdict"] == "pass"
