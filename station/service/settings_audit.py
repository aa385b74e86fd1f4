"""The settings of a start, so that the audit contains the differences from the previous start."""

from __future__ import annotations

import getpass
import hashlib
import json
import secrets
from collections.abc import Iterator, Mapping

from pydantic import JsonValue

from station.credentials import IN_ADDRESS, without_credentials
from station.records import STATION, Actor
from station.settings import Settings
from station.store import Store

_OF = " (secret part)"


def record_settings(store: Store, settings: Settings) -> None:
    """Store the settings of this start and record every change since the last, with the account."""
    values = dict(_flat(settings_of(settings)))
    hidden: dict[str, str] = {}
    before = store.settings_in_use()
    for key, value in values.items():
        if key.startswith("outbox.") and key.endswith(".url") and (found := IN_ADDRESS.search(value)):
            values[key] = without_credentials(value)
            hidden[key + _OF] = _hashed(found[0], before.get(key + _OF))
    store.use_settings(
        _who_starts(), {**values, **hidden}, frozenset(k for k in (*before, *hidden) if k.endswith(_OF))
    )


def _who_starts() -> Actor:
    try:
        return Actor(name=getpass.getuser(), via="terminal")
    except (KeyError, OSError):  # an account without a name, as in some containers
        return STATION


def settings_of(settings: Settings) -> dict[str, JsonValue]:
    """All options as in a station file that states every one."""
    sections: dict[str, JsonValue] = settings.model_dump(mode="json", exclude={"scale", "servo"})
    if settings.scale is not None:
        sections["scale"] = settings.scale.flat()
    if settings.servo is not None:
        sections["servo"] = settings.servo.flat()
    return sections


def _flat(value: JsonValue, key: str = "") -> Iterator[tuple[str, str]]:
    """`limits.speed_deg_s`, `servo.joint.1.unit`: every option with its value, in text."""
    parts: Mapping[str, JsonValue] = {}
    if isinstance(value, dict):
        parts = value
    elif isinstance(value, list):
        parts = {str(number): part for number, part in enumerate(value, start=1)}
    else:
        yield key, json.dumps(value, ensure_ascii=False)
    for name, part in parts.items():
        yield from _flat(part, f"{key}.{name}" if key else name)


def _hashed(secret: str, kept: str | None) -> str:
    """The same text for the same secret, from which the secret cannot be derived."""
    salt = kept.partition("$")[0] if kept else secrets.token_hex(16)
    digest = hashlib.scrypt(secret.encode(), salt=bytes.fromhex(salt), n=2**14, r=8, p=1)
    return f"{salt}${digest.hex()}"
