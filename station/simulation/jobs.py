"""What is asked for in a simulated day, and what goes wrong meanwhile."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from station.simulation.clients import Client
from station.simulation.witness import Witness


@dataclass(frozen=True, slots=True, order=True)
class Job:
    """Somebody asks for a run, and something happens."""

    day: int
    number: int
    """Of the day."""
    deed: str
    trouble: str


@dataclass(frozen=True, slots=True)
class Script:
    """Which of the jobs that are drawn come about; each draws by itself, whatever becomes of the others."""

    kept: frozenset[tuple[int, int]] | None = None
    """Day and number; None: all."""
    calm: frozenset[tuple[int, int]] = frozenset()
    """Where nothing goes wrong."""

    def keeps(self, day: int, number: int) -> bool:
        return self.kept is None or (day, number) in self.kept

    def has_day(self, day: int) -> bool:
        """Whether anything is left of a day."""
        return self.kept is None or any(kept_day == day for kept_day, _ in self.kept)


WHOLE = Script()
"""Everything as it is drawn."""


@dataclass(frozen=True)
class Request:
    """For a run."""

    client: Client
    path: str
    body: Mapping[str, object]
    action: str
    """What the audit calls it."""
    key: str | None

    def send(self, witness: Witness) -> int:
        """The number of the run that was started, or 0; the witness hears of the answer.

        :raises NotRunning: the station was killed before it answered, or does not run
        """
        answer = self.client.send("POST", self.path, self.body, key=self.key)
        witness.answered(answer)
        if answer.run:
            witness.started_by(self.client.name, self.action, answer.run)
            if self.key is not None:
                witness.started(self.key, answer.run)
        return answer.run
