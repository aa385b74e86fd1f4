"""Secrets that the station makes: API keys, cookies, the link of the first administrator.

They have 256 random bits, so a plain hash is sufficient for storage: they cannot be guessed. Passwords are
different (`station.people.passwords`).
"""

from __future__ import annotations

import hashlib
import secrets

_BYTES = 32


def new_secret(prefix: str = "") -> str:
    """A secret in characters for a header, a cookie or an address."""
    return prefix + secrets.token_urlsafe(_BYTES)


def secret_hash(secret: str) -> bytes:
    """SHA-256, as it is stored and looked up."""
    return hashlib.sha256(secret.encode("utf-8", "surrogatepass")).digest()
