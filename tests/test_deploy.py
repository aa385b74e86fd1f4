"""What is handed to a plant: the service asks for what exists, and a bundle that was changed is refused."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from station.cli import main

ROOT = Path(__file__).parents[1]
DEPLOY = ROOT / "deploy"


@pytest.mark.parametrize("file", ["fivebar-station.service", "Containerfile"])
def test_the_command_of_the_service_and_of_the_container_exists(file: str) -> None:
    text = (DEPLOY / file).read_text()
    options = re.findall(r"--[a-z]+", re.search(r"(ExecStart=|^CMD ).*", text, re.M)[0])  # type: ignore[index]
    assert options
    known = CliRunner().invoke(main, ["serve", "--help"]).output
    assert [option for option in options if option not in known] == []
    assert re.search(r"^(User=|USER )station$", text, re.M), "not as root"


def test_the_bill_of_materials_names_every_package(tmp_path: Path) -> None:
    bin = Path(sys.executable).parent
    subprocess.run([DEPLOY / "bill-of-materials", bin, tmp_path], cwd=ROOT, check=True, timeout=60)
    python = json.loads((tmp_path / "python.cdx.json").read_text())["components"]
    locked = re.findall(r"^([\w.-]+)==(\S+)", (DEPLOY / "requirements.lock").read_text(), re.M)
    assert {(part["name"], part["version"]) for part in python} == set(locked)
    page = json.loads((tmp_path / "page.cdx.json").read_text())["components"]
    used = json.loads((ROOT / "web/ui/package.json").read_text())["dependencies"]
    assert set(used.items()) <= {(part["name"], part["version"]) for part in page}


def bundle(folder: Path) -> None:
    shutil.copy(DEPLOY / "install", folder)
    (folder / "requirements.lock").write_text("# nothing\n")
    lines = [
        f"{hashlib.sha256(path.read_bytes()).hexdigest()}  ./{path.name}\n"
        for path in sorted(folder.iterdir())
    ]
    (folder / "SHA256SUMS").write_text("".join(lines))


def install(folder: Path) -> subprocess.CompletedProcess[str]:
    into = folder / "into"
    return subprocess.run(["sh", folder / "install", into], capture_output=True, text=True, timeout=60)


def test_a_bundle_that_was_changed_on_the_way_installs_nothing(tmp_path: Path) -> None:
    bundle(tmp_path)
    (tmp_path / "requirements.lock").write_text("numpy==0.0.1\n")
    refused = install(tmp_path)
    assert (refused.returncode, refused.stderr.splitlines()[-1]) == (
        2,
        "The bundle is not as it was made; copy it again.",
    )
    assert not (tmp_path / "into").exists()


def test_a_whole_bundle_is_not_refused_for_its_hashes(tmp_path: Path) -> None:
    bundle(tmp_path)
    assert "not as it was made" not in install(tmp_path).stderr  # what is missing is the rest of it


def test_the_lock_files_name_no_address() -> None:
    for lock in (DEPLOY / "requirements.lock", ROOT / "tests/requirements.lock"):
        assert "://" not in lock.read_text()
