"""Every state in each language: as in its picture, readable, accessible, with nothing left in English."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from station.certificate.pdf import CHINESE_FONTS
from tests.browser.conftest import BUILT_PAGE, SMALL, Station, needed
from tests.browser.looks import foreign_words, spoiled, trouble_with
from tests.browser.steps import HOLD_MS, add_run, violations
from tests.browser.test_languages import SIZES, WORDS
from tests.waiting import soon

Pages = dict[str, Page]
OUTSIDE = {"shaft_pulses": [-25000, -22222], "zero_pulses": [0, 0]}
"""Of the emulated drives: joints at -45 and 140 deg, outside the workspace."""
OFFLINE_MS = 10_000
CALIBRATE, CONFIRM = ".start button.act:not(.hold)", ".start .hold"


@pytest.fixture(scope="module")
def pages(chromium: Browser) -> Iterator[Pages]:
    """One page in each language."""
    needed(CHINESE_FONTS[0].is_file(), f"the font {CHINESE_FONTS[0]}")
    opened: Pages = {}
    for language in WORDS:
        page = chromium.new_context(viewport=SMALL).new_page()  # type: ignore[arg-type]
        page.add_init_script(f"localStorage.setItem('language', '{language}')")
        page.set_default_timeout(15_000)
        opened[language] = page
    yield opened
    for page in opened.values():
        page.context.close()


@contextmanager
def serving(home: Path, config: str = "") -> Iterator[Station]:
    needed(*BUILT_PAGE)
    (home / "station.toml").write_text(config)
    station = Station(home, speed=1000.0, config=home / "station.toml")
    yield station
    station.close()


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    """One with a run, with people, and with a receiver that never answers."""
    home = tmp_path_factory.mktemp("desk")
    (secret := home / "secret").write_text("whsec_" + b64encode(bytes(24)).decode())
    webhook = f'[[outbox.webhook]]\nurl = "http://127.0.0.1:9/"\nsecret_file = {json.dumps(str(secret))}\n'
    with serving(home, webhook) as station:
        add_run(station, "FB-7")
        people = {"name": "Cleo", "role": "engineer", "password": "correct horse"}
        station.api.post("/users", json=people).raise_for_status()
        station.api.post("/keys", json={"name": "line 9", "role": "mes"}).raise_for_status()
        yield station


def look_at(pages: Pages, name: str, besides: str = "code", *, steady: bool = True) -> None:
    """All that is asked of a state; in one language where the others would answer the same.

    :param besides: selector of what may be in English, names and identifiers on record
    :param steady: whether it looks the same every time
    """
    found = [
        *(trouble_with(page, f"{language}/{name}") for language, page in pages.items() if steady),
        *(text for page in pages.values() for text in spoiled(page) if not steady),
        *(f"in English: {word}" for word in foreign_words(pages["zh"], besides)),
        *violations(pages["en"]),
    ]
    for size, window in SIZES.items():
        pages["de"].set_viewport_size(window)
        found += [f"{size}: {text}" for text in spoiled(pages["de"])]
    pages["de"].set_viewport_size(SMALL)  # type: ignore[arg-type]
    assert [trouble for trouble in found if trouble] == []


def show(pages: Pages, station: Station, address: str, last: str) -> None:
    for page in pages.values():
        page.goto(f"{station.url}{address}")
        expect(page.locator(last).first).to_be_visible()
        if page.locator(".start").count():  # what the plan promises comes later
            expect(page.locator("#plan-promise")).to_be_visible()


@dataclass(frozen=True)
class State:
    """What is done at each page until the state is there."""

    last: str
    """What is there last."""
    address: str = "/"
    act: Callable[[Page], Any] = lambda page: None
    besides: str = "code"
    """Selector of names and identifiers on record."""
    steady: bool = True


def press_calibrate(page: Page, serial: str = "FB-7", plan: str = "full") -> None:
    page.locator("#robot_serial").fill(serial)
    page.locator("#operator").fill("ada")
    page.locator("#plan").select_option(plan)
    page.locator(CALIBRATE).click()


def be_armed(page: Page) -> None:
    """Before a clock that stands still: otherwise it lasts ten seconds."""
    page.evaluate("() => { const now = performance.now(); performance.now = () => now; }")
    press_calibrate(page)


def be_refused(page: Page) -> None:
    press_calibrate(page, "FB-NEW", "check")
    page.locator(CONFIRM).click(delay=HOLD_MS)


STATES = {
    "armed": State(".start .hold:enabled", act=be_armed),
    "refused": State("#trouble:not(:empty)", act=be_refused),
    "stopped": State("header .report", act=lambda page: page.locator(".stop").click()),
    "people-known": State(
        ".maintenance tr:has(td) >> nth=1", "/maintenance?part=people", besides="td, th[scope=row]"
    ),
    "audit": State("tbody tr", "/maintenance?part=audit&cursor=4", besides="td, th[scope=row]"),
    "deliveries": State("tbody tr", "/maintenance?part=deliveries", besides="td, th[scope=row]"),
    "backups": State("main button", "/maintenance?part=backups"),
    "versions": State("main dd", "/maintenance?part=versions", besides="dd, dt, td, th"),
    # which device is asked first differs from run to run
    "wire": State("tbody tr:nth-child(9)", "/maintenance?part=wire&run=1&cursor=20", steady=False),
}


@pytest.mark.parametrize("name", STATES)
def test_a_state_looks_as_in_its_picture(pages: Pages, desk: Station, name: str) -> None:
    state = STATES[name]
    show(pages, desk, state.address, "main h1, main h2")
    for language, page in pages.items():
        expect(page.locator("main")).not_to_contain_text(WORDS[language][3])
        state.act(page)
        expect(page.locator(state.last).first).to_be_visible()
    look_at(pages, name, state.besides, steady=state.steady)


def test_an_exercise_looks_as_in_its_picture(pages: Pages, desk: Station) -> None:
    desk.api.post("/emulator/training/draw", json={"groups": ["unnamed"]}).raise_for_status()
    show(pages, desk, "/maintenance?part=training", ".pairs")
    look_at(pages, "exercise")
    desk.api.post("/emulator/training/repair").raise_for_status()


def test_a_question_looks_as_in_its_picture(pages: Pages, desk: Station) -> None:
    body = {"robot_serial": "FB-7", "plan": "reference", "operator": "ada"}
    run = desk.api.post("/calibrations", json=body).raise_for_status().json()["id"]
    soon(lambda: desk.get(f"/calibrations/{run}")["state"] == "waiting")
    show(pages, desk, "/", ".prompt #answer")
    look_at(pages, "waiting")
    desk.api.post(f"/calibrations/{run}/abort").raise_for_status()


@pytest.mark.parametrize("language", WORDS)
def test_the_certificate_looks_as_in_its_picture(pages: Pages, desk: Station, language: str) -> None:
    page = pages[language]
    page.goto(f"{desk.url}/api/v1/calibrations/1/certificate.html?language={language}")
    assert violations(page) == []
    assert trouble_with(page, f"{language}/certificate") is None


def test_signing_in_looks_as_in_its_picture(pages: Pages, tmp_path: Path) -> None:
    with serving(tmp_path, "[service]\nopen = false\n") as station:
        show(pages, station, "/sign-in#first=secret", "#password")
        look_at(pages, "first-administrator")
        # another address, else the browser only moves within the page
        show(pages, station, "/", "#password")
        for page in pages.values():
            page.locator("#name").fill("ada")
            page.locator("#password").fill("wrong")
            page.locator("button.act").click()
            expect(page.locator("form .alarm")).to_be_visible()
        look_at(pages, "sign-in-refused")


def test_away_and_outside_looks_as_in_its_picture(pages: Pages, tmp_path: Path) -> None:
    (tmp_path / "emulated-rig.json").write_text(json.dumps(OUTSIDE))
    with serving(tmp_path) as station:
        show(pages, station, "/", "section:has(#retract-operator)")
        look_at(pages, "retract")
        station.freeze()
        for page in pages.values():
            expect(page.locator("header .alarm.act")).to_be_visible(timeout=OFFLINE_MS)
        look_at(pages, "frozen")
        station.kill()
        for page in pages.values():
            page.locator("nav a[href='/history']").click()
            page.locator(".stop").click()
            expect(page.locator("header .report.act")).to_be_visible()
            expect(page.locator(".list .empty")).to_be_visible()
        look_at(pages, "offline")
