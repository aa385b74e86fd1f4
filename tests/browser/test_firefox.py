"""The way from the scan to the certificate in Debian's Firefox ESR, over WebDriver BiDi."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from tests.browser.conftest import Station, needed

FOLDER = Path(__file__).parent / "firefox"
LIMIT_S = 90.0


def test_from_the_scan_to_the_certificate(station: Station) -> None:
    firefox = shutil.which("firefox-esr")
    needed(firefox, "firefox-esr")
    node = shutil.which("node", path=os.pathsep.join([os.environ["PATH"], str(Path(sys.executable).parent)]))
    needed(node and (FOLDER / "node_modules").is_dir(), "puppeteer-core (npm ci in tests/browser/firefox)")
    assert node and firefox
    ended = subprocess.run(
        [node, "flow.js", firefox, station.url],
        cwd=FOLDER, capture_output=True, text=True, timeout=LIMIT_S, check=False,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    seen = json.loads(ended.stdout)
    applied, run = station.get("/calibrations?limit=2")["items"]
    found = station.get(f"/calibrations/{run['id']}")
    assert seen["errors"] == []
    # the second serial replaced the first
    assert seen["scanned"][:2] == [found["robot_serial"], found["operator"]] == ["FB-7", "Ada"]
    assert f"{found['accuracy']['bound_95_mm']:.3f}" in seen["decision"]
    assert (applied["kind"], applied["of"], applied["verdict"]) == ("apply", run["id"], "pass")
    assert seen["title"] == "Calibration certificate"
