"""A headless Chromium that may only access this computer, and stations to show in it."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import httpx2 as httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, Route, sync_playwright

from tests.waiting import soon
from web import pages

ROOT = Path(__file__).parents[2]
FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip
SMALL, LARGE = {"width": 1024, "height": 768}, {"width": 1280, "height": 800}
BUILT_PAGE = (pages.STATIC / "index.html").is_file(), "the built page (npm run build in web/ui)"
END_LIMIT_S = 15.0
RUN_LIMIT_S = 120.0
RECORD = "STATION_RECORD"
"""Environment variable: folder in which each test leaves a trace and its last picture."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)


def needed(found: object, what: str) -> None:
    """Without the program the tests are skipped; where nothing may be skipped, they fail."""
    if not found and os.environ.get("CI") == "true":
        pytest.fail(f"{what} is needed for the browser tests")
    if not found:
        pytest.skip(f"{what} is not there")


class Station:
    """A `station serve` process on the emulated rig of its home folder."""

    def __init__(self, home: Path, speed: float, rig: Path | None = None, config: Path | None = None) -> None:
        command = [sys.executable, "-m", "station", "--home", str(home), "serve"]
        self.process = subprocess.Popen(
            [
                *command,
                "--port",
                str(self._port(home)),
                "--speed",
                str(speed),
                *(["--emulate", str(rig)] if rig else []),
                *(["--config", str(config)] if config else []),
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            cwd=ROOT,
            start_new_session=True,
        )
        assert self.process.stdout
        said = self.process.stdout.readline()
        found = re.search(r"http://\S+", said)
        assert found, f"the station did not start: {said}"
        self.url = found[0]
        (home / "port").write_text(str(urlsplit(self.url).port))
        self.api = httpx.Client(base_url=f"{self.url}/api/v1", timeout=10)

    @staticmethod
    def _port(home: Path) -> int:
        """A restarted station has its old address."""
        kept = home / "port"
        return int(kept.read_text()) if kept.is_file() else 0

    def get(self, path: str) -> Any:
        return self.api.get(path).json()

    def bring_back(self) -> None:
        """A stopped run-up may end outside the workspace."""
        if self.get("/station")["retract"]["needed"]:
            self._ended("/retract", {})

    def complete(self, **body: object) -> dict[str, Any]:
        """A complete run, started as a MES does; its record after the end."""
        return self._ended("/calibrations", body)

    def _ended(self, path: str, body: dict[str, object]) -> dict[str, Any]:
        def begun() -> int | None:
            answer = self.api.post(path, json={"operator": "mes", **body})
            if answer.status_code == httpx.codes.CONFLICT and "Retry-After" in answer.headers:
                return None  # the run before is on record as ended and leaves the rig in a moment
            run: int = answer.raise_for_status().json()["id"]
            return run

        run = soon(begun)

        def ended() -> dict[str, Any] | None:
            found: dict[str, Any] = self.get(f"/calibrations/{run}")
            return None if found["state"] in ("queued", "running") else found

        return soon(ended, within_s=RUN_LIMIT_S)

    def freeze(self) -> None:
        self.process.send_signal(signal.SIGSTOP)

    def thaw(self) -> None:
        self.process.send_signal(signal.SIGCONT)

    def kill(self) -> None:
        self.process.kill()
        self.close()

    def close(self) -> None:
        if self.process.poll() is None:
            self.thaw()
            self.process.terminate()
        self.process.wait(END_LIMIT_S)
        assert self.process.stdout
        self.process.stdout.close()
        self.api.close()


Serve = Callable[..., Station]


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Serve]:
    """Starts stations; with the same home a station has its earlier history and address."""
    needed(*BUILT_PAGE)
    with ExitStack() as opened:

        def serve(
            home: Path | None = None,
            speed: float = 200.0,
            rig: Path | None = None,
            config: Path | None = None,
        ) -> Station:
            station = Station(home or tmp_path, speed, rig, config)
            opened.callback(station.close)
            return station

        yield serve


@pytest.fixture(scope="package")
def station(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    """One station for the tests that leave no run active."""
    needed(*BUILT_PAGE)
    station = Station(tmp_path_factory.mktemp("station"), speed=200.0)
    yield station
    station.close()


@pytest.fixture(scope="package")
def stoppable_station(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    needed(*BUILT_PAGE)
    station = Station(tmp_path_factory.mktemp("slow-station"), speed=5.0)
    yield station
    station.close()


@pytest.fixture
def slow_station(stoppable_station: Station) -> Station:
    """The same, in its workspace, with a machine slow enough to be stopped in the middle of a run."""
    stoppable_station.bring_back()
    return stoppable_station


@pytest.fixture(scope="package")
def chromium() -> Iterator[Browser]:
    # closed with this package: its event loop would disturb other tests' own
    path = shutil.which("chromium")
    needed(path, "chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


@contextmanager
def recorded(context: BrowserContext, name: str) -> Iterator[None]:
    """If a folder is given, every step is recorded there, for `playwright show-trace`."""
    folder = os.environ.get(RECORD)
    if not folder:
        yield
        return
    context.tracing.start(title=name, screenshots=True, snapshots=True)
    yield
    for page in context.pages:
        page.screenshot(path=Path(folder) / f"{name}.png", full_page=True)
    context.tracing.stop(path=Path(folder) / f"{name}.zip")


@pytest.fixture
def context(chromium: Browser, request: pytest.FixtureRequest) -> Iterator[BrowserContext]:
    """Any request that is not for this computer is refused, and fails the test; so does any page error."""
    context = chromium.new_context(viewport=SMALL)  # type: ignore[arg-type]
    foreign: list[str] = []
    errors: list[str] = []

    def judge(route: Route) -> None:
        if urlsplit(route.request.url).hostname == "127.0.0.1":
            route.continue_()
        else:
            foreign.append(route.request.url)
            route.abort()

    context.route("**/*", judge)
    context.on("weberror", lambda error: errors.append(str(error.error)))
    context.on("console", lambda said: errors.append(said.text) if "Security Policy" in said.text else None)
    with recorded(context, request.node.name):
        yield context
    context.close()
    assert foreign == []
    assert errors == []


@pytest.fixture
def page(context: BrowserContext) -> Page:
    page = context.new_page()
    page.set_default_timeout(15_000)
    return page
