"""The requests of a simulated day, and their disturbances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from station.simulation.clients import Client
from station.simulation.witness import Witness

_BEGINS = {"apply": "run.applied", "rollback": "run.rolled_back"}
"""Audit action by kind of run. A roll-back may be answered with the application that rolled itself back."""


@dataclass(frozen=True, slots=True, order=True)
class Job:
    """A request for a run, with a disturbance."""

    day: int
    number: int
    """Number within the day."""
    deed: str
    trouble: str


@dataclass(frozen=True, slots=True)
class Script:
    """Selection of the drawn jobs to carry out; each draws independently of the others."""

    kept: frozenset[tuple[int, int]] | None = None
    """Day and number; None: all."""
    calm: frozenset[tuple[int, int]] = frozenset()
    """Jobs without a disturbance."""

    def keeps(self, day: int, number: int) -> bool:
        return self.kept is None or (day, number) in self.kept

    def has_day(self, day: int) -> bool:
        """Whether a day has any jobs left."""
        return self.kept is None or any(kept_day == day for kept_day, _ in self.kept)


WHOLE = Script()
"""Everything as drawn."""


@dataclass(frozen=True)
class Request:
    """A request for a run."""

    client: Client
    path: str
    body: Mapping[str, object]
    action: str
    """Its name in the audit."""
    key: str | None

    def send(self, witness: Witness) -> int:
        """The number of the started run, or 0; the witness receives the answer.

        :raises NotRunning: the station was killed before it answered, or does not run
        """
        answer = self.client.send("POST", self.path, self.body, key=self.key)
        witness.answered(answer)
        if answer.run and _BEGINS.get(answer.body["kind"], "run.started") == self.action:
            witness.started_by(self.client.name, self.action, answer.run)
        if self.key is not None and answer.run:
            witness.started(self.key, answer.run)
        elif self.key is not None:
            witness.refused(self.key, answer.status)
        return answer.run
