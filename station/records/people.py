"""The users of the station: roles, users, keys, and their actions."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal

from pydantic import AfterValidator, JsonValue, StringConstraints

from station.errors import InputRefused
from station.records.names import checked_account
from station.records.record import Record

Role = Literal["viewer", "operator", "engineer", "administrator", "mes"]
Via = Literal["user", "key", "panel", "open", "terminal", "station"]
"""How a person is identified: by sign-in, by a key, at the panel, in open mode, at the computer's own
terminal; or the station itself.
"""


def _account(text: str) -> str:
    try:
        return checked_account(text)
    except InputRefused as refused:
        raise ValueError(str(refused)) from refused


PersonName = Annotated[
    str,
    StringConstraints(strip_whitespace=True, min_length=1, max_length=64, pattern=r"^[\w.@+\- ]+$"),
    AfterValidator(_account),
]


class Actor(Record):
    """The author of an action."""

    name: str
    via: Via
    role: Role | None = None
    """Null if nobody is signed in."""


STATION = Actor(name="station", via="station")


class User(Record):
    """A person who signs in with a password, or with badge and PIN."""

    id: int
    name: str
    role: Role
    has_badge: bool
    by_provider: bool = False
    """The user signs in with the plant's provider, which also decides the role."""
    disabled: bool
    """The account exists, but cannot sign in."""
    created_at: datetime | None


class Credentials(Record):
    """A user with the reference for checking the sign-in."""

    user: User
    secret_hash: str
    """Hash of the password, or of the PIN; argon2."""


class ApiKey(Record):
    """A key of a program; the key itself is not stored."""

    id: int
    name: str
    role: Role
    created_at: datetime | None
    expires_at: datetime | None
    revoked_at: datetime | None
    used_at: datetime | None
    """Last use, to the minute."""


class Session(Record):
    """A person who is signed in at the page."""

    user: User
    seen_at: datetime


class SignedIn(Record):
    """The person of a request: the answer about a session."""

    name: str
    role: Role | None
    via: Via
    signs_off_after_s: float | None = None
    """Time without activity while no run is active; null for users who are not signed in with a password."""
    sign_out_at: str | None = None
    """Next address for a page, so that the provider signs out as well; null for the station's own users."""


class AuditEntry(Record):
    """One action. Entries are chained by their hashes and never changed."""

    n: int
    at: datetime
    who: str | None
    """Null if the person's name was erased."""
    via: Via
    role: Role | None
    action: str
    subject: str
    """The object of the action, for instance `run 7`."""
    before: JsonValue
    after: JsonValue
    hash: str


class AuditChecked(Record):
    """The result of checking the whole audit."""

    entries: int
    """Number of unchanged entries, up to the first changed one."""
    head: str
    """Hash of the last of these."""
    broken: int | None
    """Number of the first changed entry."""
