"""Names, passwords and tokens in addresses of a station file, which are neither shown nor stored."""

from __future__ import annotations

import re

IN_ADDRESS = re.compile(r"(?<=://).+(?=@)|(?<=\?).+")
"""Name and password of an address, and its query, which contains a token for some receivers."""


def without_credentials(text: str) -> str:
    """The text with `***` for the credentials, if it is an address."""
    return IN_ADDRESS.sub("***", text) if "://" in text else text
