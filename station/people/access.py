"""The author of a request: by key or session, looked up each time, so that changes apply at once."""

from __future__ import annotations

import hmac
import logging
import time
from collections.abc import Callable
from datetime import UTC, datetime
from threading import BoundedSemaphore, Lock

from station.errors import Forbidden, NotSignedIn, StoreUnavailable, TooManyTries
from station.people.keys import new_secret, secret_hash
from station.people.passwords import hashed_password, matches
from station.people.roles import ALLOWED, Permission, allowed_roles
from station.people.tries import Tries
from station.records import Actor, Role, SignedIn, User, account_key
from station.store import Store

log = logging.getLogger(__name__)

KEY_PREFIX = "fbs_"
"""Identifies the purpose of a key that is found in a text."""
PROVIDER_SIGN_OUT = "/api/v1/session/openid/end"
SIGN_IN = "Sign in, or send an API key in the header `Authorization: Bearer KEY`."
BUSY_S = 2.0
"""Waiting time in the answer while others are being signed in."""
_AT_ONCE = 4
"""Number of passwords being checked or waiting: each check takes 64 MB and a processor for a moment."""


class Access:
    """Thread safe. `StoreUnavailable` is raised if the history cannot be read."""

    def __init__(
        self,
        store: Store,
        *,
        open: bool,
        idle_s: float = 3600.0,
        busy: Callable[[], bool] = lambda: False,
        tries: Tries | None = None,
    ) -> None:
        """:param open: requests without credentials have all rights
        :param idle_s: time without activity after which a session ends
        :param busy: whether the machine moves: sessions do not end then
        """
        self.open = open
        self._store, self._idle_s, self._busy = store, idle_s, busy
        self._tries = tries or Tries()
        self._hashing, self._waiting = Lock(), BoundedSemaphore(_AT_ONCE)
        self._lock = Lock()
        self._used_keys: dict[int, int] = {}
        self._seen_sessions: dict[bytes, int] = {}
        self._first: bytes | None = None

    def actor(
        self, key: str | None, cookie: str | None, *, named: str | None = None, active: bool = True
    ) -> Actor:
        """The author of a request: by key, otherwise by cookie, otherwise anybody if the station is open.

        :param named: the name in a request in open mode
        :param active: whether this shows activity of a user at the page
        :raises NotSignedIn: with the reason
        """
        if key is not None:
            return self._by_key(key)
        if cookie is not None and (user := self._by_cookie(cookie, active)) is not None:
            return Actor(name=user.name, via="user", role=user.role)
        if self.open:
            return Actor(name=named or "somebody", via="open", role="administrator")
        if cookie is not None:
            raise NotSignedIn("The session has ended; sign in again.")
        raise NotSignedIn(SIGN_IN)

    def _by_key(self, key: str) -> Actor:
        digest = secret_hash(key)
        kept = self._store.key(digest)
        # the index found it by its hash; measuring the time reveals nothing about the key
        if kept is None or not hmac.compare_digest(digest, secret_hash(key)):
            raise NotSignedIn("This API key is not known here.")
        if kept.revoked_at is not None:
            raise NotSignedIn(
                f"This API key ({kept.name}) was revoked at {kept.revoked_at:%Y-%m-%d %H:%M} UTC."
            )
        if kept.expires_at is not None and kept.expires_at <= datetime.now(UTC):
            raise NotSignedIn(f"This API key ({kept.name}) expired at {kept.expires_at:%Y-%m-%d %H:%M} UTC.")
        with self._lock:
            self._used_keys[kept.id] = _now_ms()
        return Actor(name=kept.name, via="key", role=kept.role)

    def _by_cookie(self, cookie: str, active: bool) -> User | None:
        digest, now = secret_hash(cookie), _now_ms()
        session = self._store.session(digest)
        if session is None:
            return None
        with self._lock:
            seen = max(self._seen_sessions.get(digest, 0), round(session.seen_at.timestamp() * 1000))
            if now - seen > self._idle_s * 1000 and not self._busy():
                return None
            if active:
                self._seen_sessions[digest] = now
        return session.user

    @staticmethod
    def check(actor: Actor, permission: Permission) -> None:
        """:raises Forbidden: the error names the roles with the permission."""
        if actor.role not in ALLOWED[permission]:
            may = allowed_roles(permission)
            named = may[0] if len(may) == 1 else f"{', '.join(may[:-1])} or {may[-1]}"
            raise Forbidden(f"This needs the role {named}; {actor.name} has the role {actor.role}.")

    # Signing in --------------------------------------------------------------------------------

    def sign_in(self, name: str, password: str, address: str) -> tuple[str, User]:
        """Sign in with a password; returns the cookie.

        :param address: address of the client, whose failures are counted
        :raises NotSignedIn: name or password is wrong; the error does not state which
        :raises TooManyTries:
        """
        return self._sign_in(
            f"name {account_key(name)}", address, password, "Name or password is wrong.", name
        )

    def sign_in_by_badge(self, badge: str, pin: str, address: str) -> tuple[str, User]:
        """The same with a badge and its PIN."""
        return self._sign_in(f"badge {badge}", address, pin, "Badge or PIN is wrong.", None, badge)

    def _sign_in(
        self, who: str, address: str, secret: str, wrong: str, name: str | None, badge: str = ""
    ) -> tuple[str, User]:
        counted = (who, f"address {address}")
        self._tries.check(*counted)
        kept = (
            self._store.credentials(name)
            if name is not None
            else self._store.badge_credentials(secret_hash(badge))
        )
        if not self._matches(secret, kept.secret_hash if kept else None) or kept is None:
            self._tries.failed(*counted)
            # without name and badge: a password may have been typed into the wrong field
            log.warning("A sign-in from %s was refused: %s", address, wrong)
            raise NotSignedIn(wrong)
        self._tries.succeeded(who)  # not the address: the owner of an account could try others' from there
        return self._begin(kept.user), kept.user

    def _matches(self, secret: str, kept_hash: str | None) -> bool:
        """One check at a time, so that guessing never takes the processor from a run."""
        if not self._waiting.acquire(blocking=False):
            raise TooManyTries(BUSY_S)
        try:
            with self._hashing:
                return matches(secret, kept_hash)
        finally:
            self._waiting.release()

    def _begin(self, user: User) -> str:
        cookie = new_secret()
        self._store.add_session(secret_hash(cookie), user)
        return cookie

    def sign_in_by_provider(self, user: User) -> str:
        """A cookie for a user whom the plant's provider has signed in."""
        return self._begin(user)

    def sign_out(self, cookie: str) -> None:
        """Sign out; repeating it is harmless."""
        self._store.end_session(secret_hash(cookie))

    def session(self, actor: Actor) -> SignedIn:
        """The session data for its user."""
        if actor.via != "user":
            return SignedIn(name=actor.name, role=actor.role, via=actor.via)
        by_provider = self._store.user(actor.name).by_provider
        return SignedIn(
            name=actor.name,
            role=actor.role,
            via=actor.via,
            signs_off_after_s=self._idle_s,
            sign_out_at=PROVIDER_SIGN_OUT if by_provider else None,
        )

    # The first administrator -------------------------------------------------------------------

    def offer_first_administrator(self) -> str | None:
        """A secret that makes the first administrator, once; None if there is one, or none is needed."""
        if self.open or self._store.administrator_known():
            return None
        secret = new_secret()
        self._first = secret_hash(secret)
        return secret

    def make_first_administrator(self, secret: str, name: str, password: str) -> tuple[str, User]:
        """:raises NotSignedIn: the secret is wrong or was used already."""
        with self._hashing:
            if self._first is None or not hmac.compare_digest(self._first, secret_hash(secret)):
                raise NotSignedIn("This link was used already or is not this station's; start it again.")
            if self._store.administrator_known():  # made at the terminal since; the link may be in a log
                raise NotSignedIn("There is an administrator already, who can add users.")
            role: Role = "administrator"
            by = Actor(name=name, via="terminal")
            user = self._store.add_user(by, name, role, password_hash=hashed_password(password))
            self._first = None
        return self._begin(user), user

    def note_use(self) -> None:
        """Record the last use of keys and sessions; at intervals, since every write has a cost."""
        with self._lock:
            keys, self._used_keys = self._used_keys, {}
            sessions = dict(self._seen_sessions)
        try:
            idle_ms = round(self._idle_s * 1000) if not self._busy() else _now_ms()
            self._store.note_use(keys, sessions, idle_ms=idle_ms)
        except StoreUnavailable:
            with self._lock:
                self._used_keys = {**keys, **self._used_keys}
            raise
        with self._lock:
            oldest = _now_ms() - 2 * self._idle_s * 1000
            self._seen_sessions = {k: ms for k, ms in self._seen_sessions.items() if ms > oldest}


def _now_ms() -> int:
    return time.time_ns() // 1_000_000
