"""Users and keys, made and ended by an administrator; secrets come in or are shown once, never again."""

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
    """Somebody who is to sign in with a password, with badge and PIN, or with either."""

    name: str
    role: Role
    password: str | None = None
    badge: str | None = None
    pin: str | None = None


@dataclass(frozen=True, slots=True)
class UserChange:
    """What is to be different; None leaves it as it is."""

    role: Role | None = None
    disabled: bool | None = None
    password: str | None = None


class Administration:
    """Every change is in the audit, in the same transaction."""

    def __init__(self, store: Store) -> None:
        self._store = store

    def add_user(self, by: Actor, new: NewUser) -> User:
        """:raises FieldRefused: nothing to sign in with, or a password or PIN that is none.
        :raises InputRefused: name or badge are taken.
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
        """A new role holds from the next request on; a disabled user is signed off at once.

        :raises NotFound: no such user.
        :raises NotApplicable: the last administrator would be one no more.
        :raises FieldRefused: a password that is none.
        """
        password_hash = None if change.password is None else hashed_password(change.password)
        user = self._store.user_by_id(user_id)
        if change.role not in (None, "administrator") or change.disabled:
            self._keep_an_administrator(user)
        return self._store.change_user(
            by, user, role=change.role, disabled=change.disabled, password_hash=password_hash
        )

    def remove_user(self, by: Actor, user_id: int) -> None:
        """The account is gone; the audit keeps what was done.

        :raises: as `change_user`.
        """
        user = self._store.user_by_id(user_id)
        self._keep_an_administrator(user)
        self._store.remove_user(by, user.name)

    def add_key(self, by: Actor, name: str, role: Role, days: float | None = None) -> tuple[ApiKey, str]:
        """What is kept of a new key, and the key itself, which nobody can show again.

        :param days: after which it expires; None: never.
        :raises InputRefused: a key of this name is in use.
        """
        key = new_secret(KEY_PREFIX)
        expires_at = None if days is None else datetime.now(UTC) + timedelta(days=days)
        return self._store.add_key(by, name, role, secret_hash(key), expires_at), key

    def _keep_an_administrator(self, user: User) -> None:
        """Nobody can lock everybody out from the page; at the computer's own terminal it stays possible."""
        others = (
            u for u in self._store.users() if u.role == "administrator" and not u.disabled and u.id != user.id
        )
        if user.role == "administrator" and not user.disabled and next(others, None) is None:
            raise NotApplicable(
                f"{user.name} is the last administrator who can sign in; make another one first."
            )
