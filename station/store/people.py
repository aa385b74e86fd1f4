"""Users, keys and sessions. Only hashes of passwords, PINs, badges, keys and cookies are stored."""

from __future__ import annotations

import sqlite3
from datetime import UTC, datetime

from sqlite_utils import Database

from station.errors import InputRefused, NotApplicable, NotFound
from station.records import Actor, ApiKey, Credentials, Role, Session, User, account_key
from station.store.audit import AuditTrail
from station.store.rows import millis, moment
from station.store.times import now_ms

_NEXT_NUMBER = (
    "SELECT 1 + max(coalesce((SELECT max(id) FROM users), 0), coalesce((SELECT"
    " max(CAST(substr(subject, 6) AS INTEGER)) FROM audit WHERE action = 'user.added'), 0))"
)
"""A number never used before: the audit, and a page loaded earlier, refer to people by their numbers."""
_USER = "users.id, users.name, users.role, badge_sha256, openid_sha256, users.created_ms, users.disabled_ms"


class People(AuditTrail):
    """Every change is recorded in the audit, in the same transaction."""

    def add_user(
        self,
        by: Actor,
        name: str,
        role: Role,
        *,
        password_hash: str | None = None,
        badge_sha256: bytes | None = None,
        pin_hash: str | None = None,
        openid_sha256: bytes | None = None,
    ) -> User:
        """:raises InputRefused: the name or the badge is in use."""
        with self._writing() as db:
            if self._user_number(name) is not None:
                raise InputRefused(f"There is a user {name} already; choose another name.")
            _refuse_taken_badge(db, badge_sha256)
            (user_id,) = db.execute(_NEXT_NUMBER).fetchone()
            db.execute(
                "INSERT INTO users"
                " (id, name, role, password_hash, badge_sha256, pin_hash, openid_sha256, created_ms)"
                " VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                [user_id, name, role, password_hash, badge_sha256, pin_hash, openid_sha256, now_ms()],
            )
            self.record(by, "user.added", f"user {user_id}", after={"role": role})
        return self.user(name)

    def set_password(self, by: Actor, name: str, password_hash: str) -> None:
        """A new password ends the sessions of the user.  :raises NotFound:"""
        user = self.user(name)
        with self._writing() as db:
            db.execute("UPDATE users SET password_hash = ? WHERE id = ?", [password_hash, user.id])
            _sign_off(db, user)
            self.record(by, "user.password_changed", f"user {user.id}")

    def set_badge(
        self, by: Actor, user: User, *, badge_sha256: bytes | None = None, pin_hash: str | None = None
    ) -> None:
        """None leaves a field unchanged. The user's sessions end: the old badge may be in other hands.

        :raises InputRefused: another user has the badge.
        """
        with self._writing() as db:
            _refuse_taken_badge(db, badge_sha256, user.id)
            db.execute(
                "UPDATE users SET badge_sha256 = coalesce(?, badge_sha256), pin_hash = coalesce(?, pin_hash)"
                " WHERE id = ?",
                [badge_sha256, pin_hash, user.id],
            )
            _sign_off(db, user)
            if badge_sha256 is not None:
                self.record(by, "user.badge_changed", f"user {user.id}")
            if pin_hash is not None:
                self.record(by, "user.pin_changed", f"user {user.id}")

    def remove_badge(self, by: Actor, user: User) -> None:
        """Badge and PIN become invalid; sessions that were opened with them end.

        :raises NotApplicable: the user would have no means to sign in.
        """
        with self._writing() as db:
            kept = db.execute("SELECT password_hash FROM users WHERE id = ?", [user.id]).fetchone()
            if kept == (None,) and not user.by_provider:
                raise NotApplicable(
                    f"Without the badge {user.name} has nothing to sign in with; give a password with it,"
                    " or disable the user."
                )
            db.execute("UPDATE users SET badge_sha256 = NULL, pin_hash = NULL WHERE id = ?", [user.id])
            _sign_off(db, user)
            self.record(by, "user.badge_removed", f"user {user.id}")

    def change_user(
        self,
        by: Actor,
        user: User,
        *,
        role: Role | None = None,
        disabled: bool | None = None,
        password_hash: str | None = None,
        badge_sha256: bytes | None = None,
        pin_hash: str | None = None,
        remove_badge: bool = False,
        keep_one: bool = False,
    ) -> User:
        """Change all given fields or none; fields that are None or already have the value are unchanged.

        :param keep_one: whether to refuse removing the last administrator's role
        :raises NotFound: the user was removed meanwhile.
        :raises NotApplicable: the last administrator would lose the role; or as `remove_badge`.
        :raises InputRefused: as `set_badge`.
        """
        with self._writing() as db:
            user = self.user_by_id(user.id)  # nobody else can change it now
            if keep_one and (role not in (None, "administrator") or disabled):
                _keep_an_administrator(db, user)
            if role not in (None, user.role):
                db.execute("UPDATE users SET role = ? WHERE id = ?", [role, user.id])
                self.record(
                    by,
                    "user.role_changed",
                    f"user {user.id}",
                    before={"role": user.role},
                    after={"role": role},
                )
            if disabled not in (None, user.disabled):
                db.execute(
                    "UPDATE users SET disabled_ms = ? WHERE id = ?", [now_ms() if disabled else None, user.id]
                )
                _sign_off(db, user)
                self.record(by, "user.disabled" if disabled else "user.enabled", f"user {user.id}")
            if password_hash is not None:
                self.set_password(by, user.name, password_hash)
            if badge_sha256 is not None or pin_hash is not None:
                self.set_badge(by, user, badge_sha256=badge_sha256, pin_hash=pin_hash)
            if remove_badge and user.has_badge:
                self.remove_badge(by, user)
        return self.user_by_id(user.id)

    def remove_user(self, by: Actor, user: User, *, keep_one: bool = False) -> None:
        """Remove the account and its sessions; its actions remain in the audit.

        :param keep_one: whether to refuse removing the last administrator
        :raises NotFound: the user was removed meanwhile.
        :raises NotApplicable: this is the last administrator.
        """
        with self._writing() as db:
            user = self.user_by_id(user.id)
            if keep_one:
                _keep_an_administrator(db, user)
            _sign_off(db, user)
            db.execute("DELETE FROM users WHERE id = ?", [user.id])
            self.record(by, "user.removed", f"user {user.id}", before={"role": user.role})

    def user(self, name: str) -> User:
        """A user by name, as `account_key` compares names. :raises NotFound:"""
        if (number := self._user_number(name)) is None:
            raise NotFound(f"There is no user {name}.")
        return self.user_by_id(number)

    def _user_number(self, name: str) -> int | None:
        """The exact name first: an older version accepted names that differ in case only."""
        known = {row["name"]: row["id"] for row in self._readers.all("SELECT name, id FROM users")}
        same = (number for other, number in known.items() if account_key(other) == account_key(name))
        return known.get(name) or next(same, None)

    def user_by_id(self, user_id: int) -> User:
        """:raises NotFound:"""
        row = self._readers.one(f"SELECT {_USER} FROM users WHERE id = ?", [user_id])
        if row is None:
            raise NotFound(f"There is no user {user_id}.")
        return _user(row)

    def user_of_provider(self, openid_sha256: bytes) -> User | None:
        """The user with this identity at an OpenID Connect provider; also a disabled one."""
        row = self._readers.one(f"SELECT {_USER} FROM users WHERE openid_sha256 = ?", [openid_sha256])
        return None if row is None else _user(row)

    def users(self) -> list[User]:
        """All users, by name."""
        return [_user(row) for row in self._readers.all(f"SELECT {_USER} FROM users ORDER BY name")]

    def credentials(self, name: str) -> Credentials | None:
        """The reference for checking the password of a user; None without user or password."""
        number = self._user_number(name)
        return None if number is None else self._credentials("users.id = ?", number, "password_hash")

    def badge_credentials(self, badge_sha256: bytes) -> Credentials | None:
        """The reference for checking the PIN of a badge."""
        return self._credentials("badge_sha256 = ?", badge_sha256, "pin_hash")

    def _credentials(self, where: str, value: int | bytes, column: str) -> Credentials | None:
        row = self._readers.one(
            f"SELECT {_USER}, {column} AS secret FROM users WHERE {where} AND {column} IS NOT NULL"
            " AND disabled_ms IS NULL",
            [value],
        )
        return None if row is None else Credentials(user=_user(row), secret_hash=row["secret"])

    # Keys --------------------------------------------------------------------------------------

    def add_key(self, by: Actor, name: str, role: Role, sha256: bytes, expires_at: datetime | None) -> ApiKey:
        """:raises InputRefused: a key of this name is in use."""
        with self._writing() as db:
            names = db.execute("SELECT name FROM api_keys WHERE revoked_ms IS NULL").fetchall()
            if account_key(name) in {account_key(other) for (other,) in names}:
                raise InputRefused(f"There is a key {name} already; revoke it first or choose another name.")
            key_id = db.execute(
                "INSERT INTO api_keys (name, role, sha256, created_ms, expires_ms) VALUES (?, ?, ?, ?, ?)",
                [name, role, sha256, now_ms(), millis(expires_at) if expires_at else None],
            ).lastrowid
            expires = expires_at.isoformat() if expires_at else None
            self.record(
                by, "key.added", f"key {key_id}", after={"name": name, "role": role, "until": expires}
            )
        return self._key_row("id = ?", int(key_id or 0))

    def revoke_key(self, by: Actor, which: str | int) -> ApiKey:
        """By number only, or by number or name as entered by a person. Repeating it is harmless.

        :raises NotFound:
        """
        key = next((k for k in reversed(self.api_keys()) if which in (k.id, str(k.id), k.name)), None)
        if key is None:
            raise NotFound(f"There is no key {which}; `station key list` shows them.")
        with self._writing() as db:
            revoked = db.execute(
                "UPDATE api_keys SET revoked_ms = ? WHERE id = ? AND revoked_ms IS NULL", [now_ms(), key.id]
            ).rowcount
            if revoked:
                self.record(by, "key.revoked", f"key {key.id}", before={"name": key.name, "role": key.role})
        return self._key_row("id = ?", key.id)

    def api_keys(self) -> list[ApiKey]:
        """All keys ever made, oldest first."""
        return [_key(row) for row in self._readers.all("SELECT * FROM api_keys ORDER BY id")]

    def key(self, sha256: bytes) -> ApiKey | None:
        """The key with this hash, active or not."""
        row = self._readers.one("SELECT * FROM api_keys WHERE sha256 = ?", [sha256])
        return None if row is None else _key(row)

    def _key_row(self, where: str, value: int) -> ApiKey:
        row = self._readers.one(f"SELECT * FROM api_keys WHERE {where}", [value])
        if row is None:
            raise NotFound(f"There is no key {value}.")
        return _key(row)

    def anybody_known(self) -> bool:
        """Whether there is a user, or a valid key."""
        row = self._readers.one(
            "SELECT 1 FROM users UNION SELECT 1 FROM api_keys WHERE revoked_ms IS NULL"
            " AND coalesce(expires_ms > ?, 1)",
            [now_ms()],
        )
        return row is not None

    def administrator_known(self) -> bool:
        """Whether a user with all rights can sign in."""
        row = self._readers.one("SELECT 1 FROM users WHERE role = 'administrator' AND disabled_ms IS NULL")
        return row is not None

    # Sessions ----------------------------------------------------------------------------------

    def add_session(self, sha256: bytes, user: User) -> None:
        """Start a session after a sign-in."""
        with self._writing() as db:
            db.execute("INSERT INTO sessions VALUES (?, ?, ?)", [sha256, user.id, now_ms()])

    def session(self, sha256: bytes) -> Session | None:
        """The user signed in with this cookie, and the time of the last activity."""
        row = self._readers.one(
            f"SELECT {_USER}, seen_ms FROM sessions JOIN users ON users.id = user_id"
            " WHERE sha256 = ? AND disabled_ms IS NULL",
            [sha256],
        )
        return (
            None
            if row is None
            else Session(user=_user(row), seen_at=datetime.fromtimestamp(row["seen_ms"] / 1000, UTC))
        )

    def end_session(self, sha256: bytes) -> None:
        """Sign out; repeating it is harmless."""
        with self._writing() as db:
            db.execute("DELETE FROM sessions WHERE sha256 = ?", [sha256])

    def note_use(self, keys: dict[int, int], sessions: dict[bytes, int], *, idle_ms: int) -> None:
        """Record the last use of keys and sessions (ms since 1970); delete sessions unused for longer."""
        with self._writing() as db:
            for key_id, used_ms in keys.items():
                db.execute("UPDATE api_keys SET used_ms = ? WHERE id = ?", [used_ms, key_id])
            for sha256, seen_ms in sessions.items():
                db.execute("UPDATE sessions SET seen_ms = ? WHERE sha256 = ?", [seen_ms, sha256])
            db.execute("DELETE FROM sessions WHERE seen_ms < ?", [now_ms() - idle_ms])

    # Runs --------------------------------------------------------------------------------------

    def started_by(self, calibration_id: int) -> Actor | None:
        """The person who started a run; None if not recorded."""
        row = self._readers.one("SELECT name, via FROM run_starters WHERE run_id = ?", [calibration_id])
        return None if row is None else Actor(name=row["name"], via=row["via"])


def _keep_an_administrator(db: Database, user: User) -> None:
    """Within the transaction that would remove one: administrators removing each other go in turn."""
    if user.role != "administrator" or user.disabled:
        return
    if not db.execute(
        "SELECT 1 FROM users WHERE role = 'administrator' AND disabled_ms IS NULL AND id != ?", [user.id]
    ).fetchone():
        raise NotApplicable(f"{user.name} is the last administrator who can sign in; make another one first.")


def _refuse_taken_badge(db: Database, badge_sha256: bytes | None, user_id: int = 0) -> None:
    """:param user_id: the user who may have it."""
    if db.execute(
        "SELECT 1 FROM users WHERE badge_sha256 = ? AND id != ?", [badge_sha256, user_id]
    ).fetchone():
        raise InputRefused("Another user has this badge; remove it there first.")


def _sign_off(db: Database, user: User) -> None:
    db.execute("DELETE FROM sessions WHERE user_id = ?", [user.id])


def _user(row: sqlite3.Row) -> User:
    return User(
        id=row["id"],
        name=row["name"],
        role=row["role"],
        has_badge=row["badge_sha256"] is not None,
        by_provider=row["openid_sha256"] is not None,
        disabled=row["disabled_ms"] is not None,
        created_at=moment(row["created_ms"]),
    )


def _key(row: sqlite3.Row) -> ApiKey:
    return ApiKey(
        id=row["id"],
        name=row["name"],
        role=row["role"],
        created_at=moment(row["created_ms"]),
        expires_at=moment(row["expires_ms"]),
        revoked_at=moment(row["revoked_ms"]),
        used_at=moment(row["used_ms"]),
    )
