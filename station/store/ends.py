"""The end of a run: what is stored, and what is shown and repeated while the store does not accept it.

An end that is not stored yet is also written to a file beside the database, if possible, so that it survives
the process: the next start stores it instead of `interrupted`.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from threading import Lock
from typing import TypeVar

from pydantic import BaseModel, TypeAdapter

from station.errors import StoreUnavailable
from station.records import (
    CalibrationResult,
    CalibrationSummary,
    Outcome,
    Reason,
    State,
    Verdict,
    because,
)

log = logging.getLogger(__name__)

S = TypeVar("S", bound=CalibrationSummary)


@dataclass(frozen=True, slots=True)
class End:
    """The end of one run."""

    state: State
    verdict: Verdict | None
    outcome: Outcome
    reason: Reason | None
    at: datetime
    result: CalibrationResult | None = field(default=None, repr=False)

    def shown_in(self, row: S) -> S:
        """The run's summary with this end."""
        reason = self.reason
        return row.model_copy(
            update={
                "state": self.state,
                "verdict": self.verdict,
                "outcome": self.outcome,
                "reason": reason.text if reason else None,
                "reason_code": reason.code if reason else None,
                "reason_params": reason.params if reason else {},
                "ended_at": self.at,
            }
        )


def end_of(
    state: State,
    result: CalibrationResult | None,
    reason: Reason | None,
    at: datetime,
    *,
    judged: bool = True,
) -> End:
    """The end to store; in case of doubt it is a failure.

    A result with a number that is not finite, or of an unsuccessful run, is never a pass.

    :param judged: False for a run that does not judge a robot: it needs no result
    """
    if result is None:
        if state is State.SUCCEEDED and not judged:
            return End(state, None, "good", reason, at)
        if state is State.SUCCEEDED:
            return End(State.FAILED, None, "failed", reason or because("no_result"), at)
        return End(state, None, _OUTCOMES[state], reason, at)
    if bad := unsound(result):
        reason = because("not_a_number_at", where=bad)
        return End(State.FAILED, "fail", "failed", reason, at, _without_numbers(result))
    reason = reason or result.reason
    if state is not State.SUCCEEDED:
        return End(state, None, _OUTCOMES[state], reason, at, result)
    return End(state, result.verdict, result.outcome, reason, at, result)


_OUTCOMES: Mapping[State, Outcome] = {
    State.FAILED: "failed",
    State.ABORTED: "aborted",
    State.INTERRUPTED: "interrupted",
}


def unsound(value: object, where: str = "") -> str | None:
    """The path of the first non-finite number in a result; None if all are finite."""
    if isinstance(value, BaseModel):
        value = value.model_dump()
    if isinstance(value, float) and not math.isfinite(value):
        return where
    parts: list[tuple[str, object]] = []
    if isinstance(value, Mapping):
        parts = [(f"{where}.{key}" if where else str(key), part) for key, part in value.items()]
    elif isinstance(value, Sequence) and not isinstance(value, str):
        parts = [(f"{where}[{i}]", part) for i, part in enumerate(value)]
    return next((bad for name, part in parts if (bad := unsound(part, name)) is not None), None)


def _without_numbers(result: CalibrationResult) -> CalibrationResult:
    """An invalid result without its numbers: its existence and method. Its readings are stored."""
    return CalibrationResult(
        verdict="fail", outcome="failed", reason=result.reason, method=result.method, zero_offsets=()
    )


_ENDS = TypeAdapter(dict[int, End])


class UnstoredEnds:
    """Ends that the store has not accepted yet, by the number of the run."""

    def __init__(self, database: Path) -> None:
        self._file = database.with_name(f"{database.name}-ends.json")
        self._lock = Lock()
        self._ends: dict[int, End] = {}

    def left_behind(self) -> dict[int, End]:
        """The ends that the last process could not store."""
        try:
            return _ENDS.validate_json(self._file.read_bytes())
        except FileNotFoundError:
            return {}
        except (OSError, ValueError):
            log.exception("%s cannot be read; the runs that it names are marked interrupted", self._file)
            return {}

    def __getitem__(self, run: int) -> End | None:
        return self._ends.get(run)

    @property
    def runs(self) -> list[int]:
        return sorted(self._ends)

    def keep(self, run: int, end: End, why: StoreUnavailable) -> End:
        """Show this end of the run from now on: never a pass, since it is not recorded."""
        if end.state is State.SUCCEEDED:
            reason = because("store_failed", text=str(why))
            end = replace(end, state=State.FAILED, verdict=None, outcome="failed", reason=reason)
        with self._lock:
            self._ends[run] = end
            self._write()
        return end

    def repeat(self, store: Callable[[int, End], object]) -> None:
        """Try each again, until one is refused."""
        for run in self.runs:
            try:
                store(run, self._ends[run])
            except StoreUnavailable:
                return
            log.warning("The end of run %d is stored now", run)
            with self._lock:
                del self._ends[run]
                self._write()

    def clear(self) -> None:
        """Delete the file: all remaining ends are stored."""
        self._file.unlink(missing_ok=True)

    def _write(self) -> None:
        try:
            if not self._ends:
                return self.clear()
            plain = {run: replace(end, result=None) for run, end in self._ends.items()}
            self._file.write_bytes(_ENDS.dump_json(plain))
        except OSError:
            log.exception("%s cannot be written: the end is known only until the process ends", self._file)
