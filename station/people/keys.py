"""Secrets that the station makes: API keys, cookies, the link of the first administrator.

They have 256 random bits, so a plain hash is enough to keep them: nobody can try them all.  Passwords are
another matter (`station.people.passwords`).
"""

from __future__ import annotations

import hashlib
import secrets

_BYTES = 32


def new_secret(prefix: str = "") -> str:
    """Fit for a header, a cookie or an address."""
    return prefix + secrets.token_urlsafe(_BYTES)


def secret_hash(secret: str) -> bytes:
    """SHA-256, as it is kept and looked up."""
    return hashlib.sha256(secret.encode("utf-8", "surrogatepass")).digest()
