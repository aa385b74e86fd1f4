"""The reference is what the code says today."""

from __future__ import annotations

import pytest

from station.reference import pages
from tests.docs.pages import ROOT

PAGES = pages()


@pytest.mark.parametrize("name", PAGES)
def test_the_reference_is_fresh(name: str) -> None:
    kept = (ROOT / "docs/reference" / name).read_text(encoding="utf-8")
    assert kept == PAGES[name], "run `make reference`"


def test_every_option_has_a_meaning() -> None:
    for name in ("station-file.md", "robot-file.md"):
        assert not [line for line in PAGES[name].splitlines() if line.endswith("|  |")]
