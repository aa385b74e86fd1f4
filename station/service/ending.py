"""The outcome of a run's procedure, before the machine was brought to standstill."""

from __future__ import annotations

from dataclasses import dataclass

from station.motion import Tripped
from station.records import CalibrationResult, Reason, State, because


@dataclass(frozen=True, slots=True)
class Ending:
    """State, and the known cause."""

    state: State
    reason: Reason | None = None
    result: CalibrationResult | None = None
    tripped: Tripped | None = None
    """The interlock that ended it."""

    def without_result(self, doubt: str | None) -> Ending:
        """The end of an unsuccessful run, with the parts of the standstill that could not be confirmed."""
        if doubt is None:
            return Ending(self.state, self.reason, tripped=self.tripped)
        said = [self.reason.text] if self.reason else []
        return Ending(self.state, because("step_failed", text=" ".join([*said, doubt])), tripped=self.tripped)
