"""Sign-in with the plant's OpenID Connect provider.

At the first sign-in a user of the station is created, identified by a hash of issuer and subject. The
provider decides the role, which is read again at every sign-in.
"""

from __future__ import annotations

import hmac
import logging
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from threading import Lock
from typing import Any

from pydantic import TypeAdapter, ValidationError

from station.errors import InputRefused
from station.people.keys import new_secret, secret_hash
from station.people.provider import Attempt, Provider, SignInRefused, Why, claim
from station.people.roles import ROLES
from station.records import STATION, PersonName, Role, User
from station.settings import OpenIdSettings
from station.store import Store

log = logging.getLogger(__name__)

BEGUN_S = 600.0
"""Time limit at the provider's page."""
MOST_BEGUN = 1000


@dataclass(frozen=True, slots=True)
class Begun:
    """The address for the browser, and the data it has to return."""

    url: str
    state: str


@dataclass(frozen=True, slots=True)
class _Waiting:
    attempt: Attempt
    earlier: str | None
    until_s: float


class OpenId:
    """Thread safe; every method may wait for the provider."""

    def __init__(
        self, settings: OpenIdSettings, store: Store, *, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """:raises InputRefused: the client's secret cannot be read."""
        self.label = settings.label
        self._settings, self._store, self._clock = settings, store, clock
        self._provider = Provider(settings)
        self._lock = Lock()
        self._waiting: OrderedDict[str, _Waiting] = OrderedDict()

    def begin(self, redirect_uri: str, earlier: str | None) -> Begun:
        """:param redirect_uri: address that the provider redirects the browser back to
        :param earlier: cookie of the user signed in at this browser, whose session will end
        :raises SignInRefused: the provider cannot be reached.
        """
        attempt, state = Attempt(new_secret(), new_secret(), redirect_uri), new_secret()
        url = self._provider.address(attempt, state)
        with self._lock:
            self._waiting[state] = _Waiting(attempt, earlier, self._clock() + BEGUN_S)
            while len(self._waiting) > MOST_BEGUN:
                self._waiting.popitem(last=False)
        return Begun(url, state)

    def complete(self, answer: Mapping[str, str], state: str | None) -> tuple[User, str | None]:
        """The user who signed in, and the cookie of the previous user.

        :param answer: parameters of the browser's return
        :param state: state given to this browser before
        :raises SignInRefused:
        """
        waiting = self._returned(answer.get("state", ""), state)
        if error := answer.get("error"):
            why: Why = "cancelled" if error == "access_denied" else "not_valid"
            raise SignInRefused(why, f"the provider says {error}: {answer.get('error_description', '')}")
        if answer.get("iss", self._settings.issuer) != self._settings.issuer:  # RFC 9207
            raise SignInRefused("not_valid", "another provider has answered")
        wanted = (self._settings.name_claim, self._settings.role_claim)
        claims = self._provider.claims(waiting.attempt, answer.get("code", ""), wanted)
        return self._user(claims), waiting.earlier

    def sign_out_url(self, back: str) -> str | None:
        """The sign-out address of the provider; None if it has none, or cannot be reached.

        :param back: address that it redirects the browser to afterwards
        """
        try:
            return self._provider.sign_out_address(back)
        except SignInRefused as refused:
            log.warning("%s: %s", self.label, refused)
            return None

    def _returned(self, state: str, of_browser: str | None) -> _Waiting:
        with self._lock:
            waiting = self._waiting.pop(state, None)
        ours = of_browser is not None and hmac.compare_digest(of_browser.encode(), state.encode())
        if waiting is None or not ours or waiting.until_s < self._clock():
            raise SignInRefused("expired", "no sign-in of this browser waits for this answer")
        return waiting

    def _user(self, claims: Mapping[str, Any]) -> User:
        known_by = secret_hash(f"{self._settings.issuer}\n{claims['sub']}")
        user, role = self._store.user_of_provider(known_by), self._role(claims)
        if user is None:
            return self._new_user(claims, role, known_by)
        if user.disabled:
            raise SignInRefused("disabled", f"{user.name} is disabled")
        return self._store.change_user(STATION, user, role=role)

    def _new_user(self, claims: Mapping[str, Any], role: Role, known_by: bytes) -> User:
        given = self._settings.name_claim
        try:
            name = TypeAdapter(PersonName).validate_python(claim(claims, given))
        except ValidationError as error:
            raise SignInRefused("not_valid", f"the claim {given} is no name") from error
        try:
            return self._store.add_user(STATION, name, role, openid_sha256=known_by)
        except InputRefused as taken:
            raise SignInRefused("name_taken", f"{name} is another user of the station") from taken

    def _role(self, claims: Mapping[str, Any]) -> Role:
        given = claim(claims, self._settings.role_claim)
        values = given if isinstance(given, list) else [given]
        roles = [
            self._settings.roles[value]
            for value in values
            if isinstance(value, str) and value in self._settings.roles
        ]
        if not roles:
            text = f"no value of the claim {self._settings.role_claim} is in [openid.roles]"
            raise SignInRefused("no_role", text)
        return max(roles, key=ROLES.index)
