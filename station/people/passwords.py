"""Passwords and PINs, by Argon2id (RFC 9106) with the library's recommended cost."""

from __future__ import annotations

from functools import cache

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError

from station.errors import FieldRefused

FEWEST_CHARACTERS = 8
FEWEST_DIGITS = 4
LONGEST = 256

_hasher = PasswordHasher()


def hashed_password(password: str) -> str:
    """:raises FieldRefused: it is too short or too long."""
    if not FEWEST_CHARACTERS <= len(password) <= LONGEST:
        raise FieldRefused("password", f"A password has {FEWEST_CHARACTERS} to {LONGEST} characters.")
    return _hasher.hash(password.encode("utf-8", "surrogatepass"))


def hashed_pin(pin: str) -> str:
    """:raises FieldRefused: it is not four or more digits."""
    if not (pin.isascii() and pin.isdecimal() and FEWEST_DIGITS <= len(pin) <= LONGEST):
        raise FieldRefused("pin", f"A PIN has {FEWEST_DIGITS} digits or more.")
    return _hasher.hash(pin)


def matches(secret: str, kept_hash: str | None) -> bool:
    """Whether a password or PIN is the stored one; takes the same time if none is stored."""
    try:
        _hasher.verify(kept_hash or _nobodys(), secret[:LONGEST].encode("utf-8", "surrogatepass"))
    except (VerificationError, InvalidHashError):
        return False
    return kept_hash is not None


@cache
def _nobodys() -> str:
    return _hasher.hash("nobody has this password")
