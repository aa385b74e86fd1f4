"""A home folder with one finished run: the example of the documentation."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from station.store import Store

EXAMPLE = Path(__file__).parents[3] / "docs/examples/recorded/station.db"


@pytest.fixture
def home(tmp_path: Path) -> Path:
    shutil.copy(EXAMPLE, tmp_path / "station.db")
    return tmp_path


@pytest.fixture
def kept(home: Path) -> Iterator[Store]:
    with closing(Store(home / "station.db")) as store:
        yield store
