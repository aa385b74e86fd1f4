"""What all the guides add, in one copy of the repository: its types and its own rules hold there as well."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs.pages import ROOT, blocks, with_code
from tests.docs.test_code import TREES, change, copy_of_the_repository

pytestmark = pytest.mark.long

RULES = (
    "tests/station/messages",
    "tests/station/plans/test_plan.py",
    "tests/station/store/test_stored_fields.py",
    "tests/station/diagnosis/explanations/test_families.py",
    "tests/test_structure.py",
    "tests/web/test_sentences.py",
)
"""Tests of everything that is registered, which a guide has to mention."""


@pytest.fixture(scope="module")
def extended(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[str]]:
    """The copy, and the Python files that the guides have added or changed."""
    folder = tmp_path_factory.mktemp("extended")
    copy_of_the_repository(folder)
    touched: set[str] = set()
    for page in with_code():
        for block in blocks(page):
            file = folder / block.name
            if block.kind == "diff":
                change(file, block.body, f"{page.relative_to(ROOT)}, line {block.line}")
            elif block.kind == "python" and block.name.partition("/")[0] in TREES:
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(block.body, encoding="utf-8")
            else:
                continue
            touched.add(block.name)
    return folder, sorted(name for name in touched if name.endswith(".py"))


def check(folder: Path, *arguments: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(folder)},
        capture_output=True,
        text=True,
        timeout=590,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.timeout(600)
def test_their_code_agrees_with_the_types(extended: tuple[Path, list[str]]) -> None:
    """A protocol that has changed shows in the classes of a guide."""
    folder, touched = extended
    assert len(touched) > 20
    check(folder, "mypy", "--config-file", "pyproject.toml", *touched)


@pytest.mark.timeout(600)
def test_they_mention_what_the_rules_ask_for(extended: tuple[Path, list[str]]) -> None:
    folder, _ = extended
    check(folder, "pytest", "-p", "no:cacheprovider", *RULES)
