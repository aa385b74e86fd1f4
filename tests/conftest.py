"""The order of the test files: no process is left alone at the end, and few browsers run at the same time."""

from __future__ import annotations

from zlib import crc32

import pytest


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Files that take longest first, the others mixed."""
    items.sort(key=lambda item: (item.get_closest_marker("long") is None, crc32(item.location[0].encode())))
