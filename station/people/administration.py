"""Users and keys, made and ended by an administrator; secrets are accepted or shown once, never again."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from station.errors import FieldRefused, NotApplicable
from station.people.access import KEY_PREFIX
from station.people.keys import new_secret, secret_hash
from station.people.passwords import hashed_password, hashed_pin
from station.records import Actor, ApiKey, Role, User
from station.store import Store


@dataclass(frozen=True, slots=True)
class NewUser:
    """A new user with a password, with badge and PIN, or with both."""

    name: str
    role: Role
    password: str | None = None
    badge: str | None = None
    pin: str | None = None


@dataclass(frozen=True, slots=True)
class UserChange:
    """Changes; None leaves a field unchanged."""

    role: Role | None = None
    disabled: bool | None = None
    password: str | None = None
    badge: str | None = None
    pin: str | None = None
    remove_badge: bool = False


class Administration:
    """Every change is recorded in the audit, in the same transaction."""

    def __init__(self, store: Store) -> None:
        self._store = store

    def add_user(self, by: Actor, new: NewUser) -> User:
        """:raises FieldRefused: there are no credentials, or the password or PIN is invalid.
        :raises InputRefused: the name or the badge is in use.
        """
        if (new.badge is None) != (new.pin is None):
            raise FieldRefused("pin", "A badge needs a PIN, and a PIN a badge; give both or none.")
        if new.password is None and new.badge is None:
            raise FieldRefused("password", "Give a password, or a badge and its PIN, to sign in with.")
        return self._store.add_user(
            by,
            new.name,
            new.role,
            password_hash=None if new.password is None else hashed_password(new.password),
            badge_sha256=None if new.badge is None else secret_hash(new.badge),
            pin_hash=None if new.pin is None else hashed_pin(new.pin),
        )

    def change_user(self, by: Actor, user_id: int, change: UserChange) -> User:
        """A new role is effective from the next request on. The sessions of a user who is disabled, or has
        new credentials, end at once.

        :raises NotFound: no such user.
        :raises NotApplicable: the last administrator would lose the role; the user would have no credentials;
        or the plant's provider manages the sign-in.
        :raises FieldRefused: the password or PIN is invalid, or a badge has no PIN.
        :raises InputRefused: another user has the badge.
        """
        user = self._store.user_by_id(user_id)
        _check_ways_in(user, change)
        return self._store.change_user(
            by,
            user,
            role=change.role,
            disabled=change.disabled,
            password_hash=None if change.password is None else hashed_password(change.password),
            badge_sha256=None if change.badge is None else secret_hash(change.badge),
            pin_hash=None if change.pin is None else hashed_pin(change.pin),
            remove_badge=change.remove_badge,
            keep_one=True,
        )

    def remove_user(self, by: Actor, user_id: int) -> None:
        """Remove the account; its actions remain in the audit.

        :raises NotFound: no such user.
        :raises NotApplicable: this is the last administrator; at the computer's own terminal it remains
        possible.
        """
        self._store.remove_user(by, self._store.user_by_id(user_id), keep_one=True)

    def add_key(self, by: Actor, name: str, role: Role, days: float | None = None) -> tuple[ApiKey, str]:
        """The record of a new key, and the key itself, which cannot be shown again.

        :param days: number of days until it expires; None: never.
        :raises InputRefused: a key of this name is in use.
        """
        key = new_secret(KEY_PREFIX)
        expires_at = None if days is None else datetime.now(UTC) + timedelta(days=days)
        return self._store.add_key(by, name, role, secret_hash(key), expires_at), key


def _check_ways_in(user: User, change: UserChange) -> None:
    """:raises: as `Administration.change_user`."""
    given = [way for way in (change.password, change.badge, change.pin) if way is not None]
    if given and user.by_provider:
        raise NotApplicable(
            f"{user.name} signs in with the plant's provider; a password or badge of the station would still"
            " open it after the provider has let the person go."
        )
    if change.remove_badge and (change.badge is not None or change.pin is not None):
        raise FieldRefused("remove_badge", "Give another badge or PIN, or remove the badge; not both.")
    if change.badge is not None and change.pin is None and not user.has_badge:
        raise FieldRefused("pin", f"{user.name} has no PIN yet; give one with the badge.")
    if change.pin is not None and change.badge is None and not user.has_badge:
        raise FieldRefused("badge", f"{user.name} has no badge yet; give one with the PIN.")
