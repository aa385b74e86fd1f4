"""The page's figures of docs/benchmarks.md, measured in Chromium.

python -m tests.browser.page_figures
"""

from __future__ import annotations

import os
import shutil
import sys
import time
from contextlib import closing
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from playwright.sync_api import Browser, Page, sync_playwright

from station.settings import database_path
from station.studies.bench import SETTINGS, ask, connected, run_times, serving
from station.studies.long_history import lengthen
from tests.browser.conftest import FLAGS, SMALL

COLD_STARTS, RUNS, LOOKS = 20, 500, 20
SHORT, LONG = 10, 100_000
EVERY = 50
"""Number of runs between two memory measurements."""
READY = "() => document.querySelector('.state strong')?.textContent === 'READY'"
WATCH_EVENTS = """() => {
  window.taken = [];
  const original = WebSocket.prototype.__lookupSetter__('onmessage');
  Object.defineProperty(WebSocket.prototype, 'onmessage', { set(handler) {
    original.call(this, event => {
      const begun = performance.now();
      let seen = false;
      const observer = new MutationObserver(() => {
        if (!seen) window.taken.push(performance.now() - begun);
        seen = true;
        observer.disconnect();
      });
      const all = {subtree: true, childList: true, attributes: true, characterData: true};
      observer.observe(document.body, all);
      setTimeout(() => observer.disconnect(), 1000);
      handler(event);
    });
  }});
}"""


def row(name: str, value: str, wanted: str) -> None:
    load = os.getloadavg()[0]
    print(f"| {name} | {value} | {wanted} | {load:.1f} |", flush=True)


def cold_starts(browser: Browser, url: str) -> list[float]:
    """ms from the request to READY, each with an empty cache."""
    times = []
    for _ in range(COLD_STARTS):
        page = browser.new_context(viewport=SMALL).new_page()  # type: ignore[arg-type]
        begun = time.perf_counter()
        page.goto(url, wait_until="commit")
        page.wait_for_function(READY)
        times.append((time.perf_counter() - begun) * 1e3)
        page.context.close()
    return times


def kept_open(page: Page, port: int) -> tuple[list[float], list[tuple[float, int]]]:
    """ms from each event to the changed page, and (MB, nodes) after collection, every `EVERY` runs."""
    collector = page.context.new_cdp_session(page)
    memory = []
    with closing(connected(port)) as http:
        for number in range(RUNS + 1):
            if number % EVERY == 0:
                collector.send("HeapProfiler.collectGarbage")
                heap = collector.send("Runtime.getHeapUsage")["usedSize"] / 1e6
                nodes = int(collector.send("Memory.getDOMCounters")["nodes"])
                memory.append((heap, nodes))
            if number == RUNS:
                break
            body = {"robot_serial": "B-1", "plan": "paper", "operator": "bench"}
            ask(http, "POST", "/api/v1/calibrations", body)
            while ask(http, "GET", "/api/v1/station")["run"] is not None:
                time.sleep(0.01)
    return page.evaluate("window.taken"), memory


def looks(page: Page, url: str) -> list[float]:
    """ms from the press of History to its first row."""
    times = []
    for _ in range(LOOKS):
        page.goto(url)
        page.wait_for_function(READY)
        begun = time.perf_counter()
        page.locator("nav a[href='/history']").click()
        page.locator(".list tbody tr").first.wait_for()
        page.locator(".found strong:not(:empty)").wait_for()
        times.append((time.perf_counter() - begun) * 1e3)
    return times


def with_history(browser: Browser, count: int) -> list[float]:
    with TemporaryDirectory() as folder:
        home = Path(folder)
        run_times(home, 1)
        lengthen(database_path(SETTINGS, home), count, readings=False)
        with serving(home) as port:
            page = browser.new_context(viewport=SMALL).new_page()  # type: ignore[arg-type]
            times = looks(page, f"http://127.0.0.1:{port}/")
            page.context.close()
    return times


def spread(times: list[float]) -> str:
    return f"median {median(times):.0f} ms, best {min(times):.0f}, worst {max(times):.0f}"


def start(browser: Browser) -> None:
    with TemporaryDirectory() as folder, serving(Path(folder)) as port:
        times = cold_starts(browser, f"http://127.0.0.1:{port}/")
    row(f"from the request to READY, nothing in the cache, {COLD_STARTS} starts", spread(times), "400 ms")


def tab(browser: Browser) -> None:
    with TemporaryDirectory() as folder, serving(Path(folder)) as port:
        page = browser.new_context(viewport=SMALL).new_page()  # type: ignore[arg-type]
        page.add_init_script(f"({WATCH_EVENTS})()")
        page.goto(f"http://127.0.0.1:{port}/")
        page.wait_for_function(READY)
        taken, memory = kept_open(page, port)
        page.context.close()
    taken.sort()
    events = f"median {median(taken):.1f} ms, 95th percentile {taken[int(0.95 * len(taken))]:.1f} ms"
    row(f"from an event of the live feed to the changed page, {len(taken)} events", events, "10 ms")
    (first, nodes), (last, nodes_last) = memory[1], memory[-1]
    grown = f"{first:.2f} MB after {EVERY} runs, {last:.2f} after {RUNS}; nodes {nodes}, {nodes_last}"
    row(f"JavaScript heap after collection, {RUNS} runs in one tab", grown, "flat")


def history(browser: Browser) -> None:
    for count in (SHORT, LONG):
        name = f"from the press of History to its rows and their count, {count:,} runs"
        row(name, spread(with_history(browser, count)), "the same")


PARTS = {"start": start, "tab": tab, "history": history}


def main(parts: list[str]) -> None:
    print("| figure | measured | wanted | 1-minute load |\n|---|---|---|---|")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        for part in parts or list(PARTS):
            PARTS[part](browser)
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:])
