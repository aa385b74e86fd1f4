"""The pages of docs/reference, made from the code: `make reference`."""

from __future__ import annotations

from station.reference.pages import pages

__all__ = [
    "pages",
]
