"""Who uses the station: roles, users, keys, and what was done by whom."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import JsonValue, StringConstraints

from station.records.record import Record

Role = Literal["viewer", "operator", "engineer", "administrator", "mes"]
Via = Literal["user", "key", "panel", "open", "terminal", "station"]
"""How somebody is known: signed in, by a key, standing at the panel, in open mode, at the computer's own
terminal; or the station by itself."""

PersonName = Annotated[
    str, StringConstraints(strip_whitespace=True, min_length=1, max_length=64, pattern=r"^[\w.@+\- ]+$")
]


class Actor(Record):
    """Who does something."""

    name: str
    via: Via
    role: Role | None = None
    """Null where nobody is signed in."""


STATION = Actor(name="station", via="station")


class User(Record):
    """Somebody who signs in with a password, or with badge and PIN."""

    id: int
    name: str
    role: Role
    has_badge: bool
    by_provider: bool = False
    """Signs in with the plant's provider, which also decides the role."""
    disabled: bool
    """Kept, but may not sign in."""
    created_at: datetime | None


class Credentials(Record):
    """A user with what the sign-in is checked against."""

    user: User
    secret_hash: str
    """Of the password, or of the PIN; argon2."""


class ApiKey(Record):
    """A key of a program; the key itself is not kept."""

    id: int
    name: str
    role: Role
    created_at: datetime | None
    expires_at: datetime | None
    revoked_at: datetime | None
    used_at: datetime | None
    """Last use, to the minute."""


class Session(Record):
    """Somebody who is signed in at the page."""

    user: User
    seen_at: datetime


class SignedIn(Record):
    """Who asks: the answer about a session."""

    name: str
    role: Role | None
    via: Via
    signs_off_after_s: float | None = None
    """Without activity, while nothing runs; null for those who are not signed in with a password."""
    sign_out_at: str | None = None
    """Where a page goes next, so that the provider signs out as well; null for the station's own users."""


class AuditEntry(Record):
    """One deed.  Entries are chained by their hashes and never changed."""

    n: int
    at: datetime
    who: str | None
    """Null when the person's name was erased."""
    via: Via
    role: Role | None
    action: str
    subject: str
    """What it was done to, for instance `run 7`."""
    before: JsonValue
    after: JsonValue
    hash: str


class AuditChecked(Record):
    """What became of a look at the whole trail."""

    entries: int
    """As they were written, up to the first that is not."""
    head: str
    """Hash of the last of these."""
    broken: int | None
    """Number of the first entry that is not as it was written."""
