"""The users of the station: an operator who signs in, a MES with a key, and a person without rights."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Any

from station.people import Administration, NewUser
from station.records import Actor
from station.simulation.clients import Answer, Client, Request
from station.simulation.plant import Plant
from station.store import Store

_PASSWORD = "correct horse battery"  # noqa: S105 - of somebody who does not exist
_ROOT = Actor(name="root", via="terminal")


@dataclass
class Operator(Client):
    """Signs in with a password whenever a session is refused."""

    def _sign_in(self) -> bool:
        answer = self._ask(Request("POST", "/session", {"name": self.name, "password": _PASSWORD}))
        if answer.cookie is None:
            return False
        self.headers["Cookie"] = answer.cookie
        return True


@dataclass
class People:
    """The people of one station; they outlive every process of it."""

    plant: Plant
    random: Random
    pulled: int = 0
    """Number of the last event that the MES has fetched."""
    _keys: int = 0
    _revoked: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.operator = Operator(self.plant, "Ada")
        self.mes = Client(self.plant, "MES 0", address="10.0.0.7")

    def begin(self) -> None:
        """Called on the first day: create an account and a key."""
        self._administration().add_user(_ROOT, NewUser(self.operator.name, "operator", _PASSWORD))
        self.renew_key()

    def renew_key(self) -> None:
        """The MES gets another key; its previous one is refused from now on."""
        if bearer := self.mes.headers.get("Authorization"):
            self._store.revoke_key(_ROOT, self.mes.name)
            self._revoked.append(bearer)
        self._keys += 1
        self.mes.name = f"MES {self._keys}"
        _, key = self._administration().add_key(_ROOT, self.mes.name, "mes")
        self.mes.headers["Authorization"] = f"Bearer {key}"

    def try_without_right(self, order: Mapping[str, object], passed: int | None) -> Answer:
        """A motion is requested without a key, with a revoked one, or with one without the permission."""
        start = ("POST", "/calibrations", order)
        stranger = Client(self.plant, "nobody", address="10.0.0.66")
        tries = [lambda: stranger.send(*start), lambda: stranger.send("POST", "/stop")]
        if self._revoked:
            stranger.headers["Authorization"] = self.random.choice(self._revoked)
        if passed is not None:
            tries.append(lambda: self.mes.send("POST", f"/calibrations/{passed}/apply", {"operator": "x"}))
        return self.random.choice(tries)()

    def pull(self) -> list[Mapping[str, Any]]:
        """Fetch the events that the MES does not have yet, in order."""
        events: list[Mapping[str, Any]] = []
        while True:
            answer = self.mes.send("GET", "/events", query=f"after={self.pulled}")
            if answer.status != 200:
                return events
            events += answer.body["items"]
            if events:
                self.pulled = int(events[-1]["n"])
            if answer.body["next"] is None:
                return events

    @property
    def _store(self) -> Store:
        assert self.plant.runtime is not None
        return self.plant.runtime.store

    def _administration(self) -> Administration:
        return Administration(self._store)
