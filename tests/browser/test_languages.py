"""Every view in each language: as in its picture, readable, accessible; the certificate speaks it too."""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import BytesIO
from typing import Any

import pytest
from playwright.sync_api import Page, ViewportSize, expect
from pypdf import PdfReader

from station.certificate.pdf import CHINESE_FONTS
from tests.browser.conftest import BUILT_PAGE, Station, needed
from tests.browser.looks import foreign_words, spoiled, trouble_with
from tests.browser.steps import open_station, violations
from tests.station.simulated import Drawn, to_csv

WORDS = {
    "en": ("English", "READY", "Calibration certificate", "Loading …"),
    "de": ("Deutsch", "BEREIT", "Kalibrierzertifikat", "Wird geladen"),
    "zh": ("中文", "就绪", "标定证书", "加载中"),
}
RUNS = (("FB-7", 9.0), ("FB-7", 0.1), ("FB-WITH-A-LONG-SERIAL-12", None))
"""Robot and wanted accuracy: kept, not kept, none."""
FOLDS = "offsets.accuracy.drives.memory.residuals.run"
VIEWS = {
    "station": ("/", ".station:has(#plan-promise):has(.readings tbody tr)"),
    "result": ("/result/1", ".maps figure:nth-child(2) .field-map"),
    "result-open": (f"/result/2?open={FOLDS}", ".chart svg"),
    "diagnosis": ("/diagnosis/4", ".pair:has(figure:nth-child(2) .chart svg)"),
    "history": (
        "/history?show=process&a=1&b=2",
        ".history:has(.field-map):has(.list tbody tr):has(.process figure:nth-child(3) .chart svg)"
        ":has(.panel:not(.process) figure:nth-child(2) .chart svg)",
    ),
    "devices": ("/maintenance?part=devices", "tbody tr"),
    "people": ("/maintenance?part=people", "select"),
    "training": ("/maintenance?part=training", "select"),
}
"""Address, and what is there last but for what says that it is loading."""
LAST_MS = 15_000
"""A plan is made, a chart loaded."""
PHONE = ViewportSize(width=390, height=844)
SMALL = ViewportSize(width=1024, height=768)
SIZES = {
    "phone": PHONE,
    "1280 at 200 %": ViewportSize(width=640, height=400),
    "1280": ViewportSize(width=1280, height=800),
    "1920": ViewportSize(width=1920, height=1080),
}
GO = """to => { history.pushState(null, "", to); dispatchEvent(new PopStateEvent("popstate")); }"""


@pytest.fixture(scope="module")
def lived(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    """A station with the same few runs whenever it is made: three calibrations and an import."""
    needed(*BUILT_PAGE)
    station = Station(tmp_path_factory.mktemp("lived"), speed=1000.0)
    for robot, accuracy in RUNS:
        station.complete(robot_serial=robot, plan="rapid", operator="ada", accuracy_mm=accuracy)
    sequence = to_csv(Drawn({"kind": "backlash", "joint": 1, "width_deg": 0.02}).sequence())
    station.api.post("/datasets", files={"file": ("log.csv", sequence)}).raise_for_status()
    yield station
    station.close()


@pytest.mark.parametrize("language", WORDS)
def test_every_view_looks_as_in_its_picture(page: Page, lived: Station, language: str) -> None:
    needed(language != "zh" or CHINESE_FONTS[0].is_file(), f"the font {CHINESE_FONTS[0]}")
    page.add_init_script(f"localStorage.setItem('language', '{language}')")
    page.goto(lived.url)
    expect(page.locator("header")).to_contain_text(WORDS[language][1])
    found: list[str | None] = []
    for name, (address, last) in VIEWS.items():
        page.evaluate(GO, address)
        expect(page.locator(last).first).to_be_visible(timeout=LAST_MS)
        expect(page.locator("main")).not_to_contain_text(WORDS[language][3])
        found += violations(page) if language == "en" else []
        found += foreign_words(page, "code, td") if language == "zh" else []
        found.append(trouble_with(page, f"{language}/{name}"))
        for size, window in SIZES.items():
            page.set_viewport_size(window)
            found += [f"{language}/{name}, {size}: {text}" for text in spoiled(page)]
        page.set_viewport_size(SMALL)
    assert [trouble for trouble in found if trouble] == []


@pytest.mark.parametrize("language", ["de", "zh"])
def test_the_page_and_the_certificate_speak_the_chosen_language(
    page: Page, lived: Station, language: str
) -> None:
    own_name, ready, certificate, _ = WORDS[language]
    run: dict[str, Any] = lived.get("/calibrations/1")
    open_station(page, lived)
    page.get_by_label("Language").select_option(label=own_name)
    expect(page.locator("header")).to_contain_text(ready)
    expect(page.locator("html")).to_have_attribute("lang", language)
    page.evaluate(GO, "/result/1")
    bound = f"{run['accuracy']['bound_95_mm']:.3f}"
    said = bound.replace(".", ",") if language == "de" else bound
    expect(page.locator(".decision")).to_contain_text(said)
    address = page.locator("a[href*='certificate.pdf']").get_attribute("href")
    assert address is not None and address.endswith(f"language={language}")
    pdf = PdfReader(BytesIO(page.request.get(f"{lived.url}{address}").body()))
    assert len(pdf.pages) == 1
    assert re.sub(r"\s", "", certificate) in re.sub(r"\s", "", pdf.pages[0].extract_text())
    page.goto(f"{lived.url}{address.replace('.pdf', '.html')}")
    expect(page.locator("h1")).to_contain_text(certificate)
    assert spoiled(page) == []
