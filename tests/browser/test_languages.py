"""Everything in the operator's language, certificate included; nothing overflows, nothing is inaccessible."""

from __future__ import annotations

import re
from io import BytesIO

import pytest
from playwright.sync_api import Page, expect
from pypdf import PdfReader

from tests.browser.conftest import Station
from tests.browser.steps import add_run, open_station, violations

WORDS = {
    "de": ("Deutsch", "BEREIT", "Kalibrieren", "Kalibrierzertifikat"),
    "zh": ("中文", "就绪", "标定", "标定证书"),
}
WIDTH = "document.documentElement.scrollWidth - document.documentElement.clientWidth"


@pytest.mark.parametrize("language", WORDS)
def test_the_page_and_the_certificate_speak_the_chosen_language(
    page: Page, station: Station, language: str
) -> None:
    own_name, ready, calibrate, certificate = WORDS[language]
    run = add_run(station)
    open_station(page, station)
    page.get_by_label("Language").select_option(label=own_name)
    expect(page.locator("header")).to_contain_text(ready)
    expect(page.locator("html")).to_have_attribute("lang", language)
    expect(page.get_by_role("button", name=calibrate).first).to_be_visible()
    assert violations(page) == []
    for view in (f"/result/{run['id']}", "/history", "/maintenance"):
        page.goto(f"{station.url}{view}")
        expect(page.locator("h1").first).to_be_visible()
        expect(page.locator("header")).to_contain_text(re.compile(ready))
        assert page.evaluate(WIDTH) <= 0
        assert violations(page) == []
    bound = f"{run['accuracy']['bound_95_mm']:.3f}"
    said = bound.replace(".", ",") if language == "de" else bound
    page.goto(f"{station.url}/result/{run['id']}")
    expect(page.locator(".decision")).to_contain_text(said)
    address = page.locator("a[href*='certificate.pdf']").get_attribute("href")
    assert address is not None and address.endswith(f"language={language}")
    pdf = PdfReader(BytesIO(page.request.get(f"{station.url}{address}").body()))
    assert len(pdf.pages) == 1
    assert re.sub(r"\s", "", certificate) in re.sub(r"\s", "", pdf.pages[0].extract_text())
    page.goto(f"{station.url}{address.replace('.pdf', '.html')}")
    expect(page.locator("h1")).to_contain_text(certificate)
    assert violations(page) == []
    assert page.evaluate(WIDTH) <= 0
