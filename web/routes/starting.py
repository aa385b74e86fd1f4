"""Common parts of the routes that start a run: the idempotency key, and the answer with the run's address."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from fastapi import Depends, Response

from station.people import Permission
from station.records import Actor, CalibrationRequest, CalibrationSummary, Submitted
from station.service import Runtime
from web.guarded import needs
from web.problems import documented
from web.routes.parts import LOCATION, IdempotencyKey, TheRuntime

STARTED: dict[int | str, dict[str, Any]] = {
    202: {"description": "Accepted", "headers": LOCATION},
    **documented(409),
}
FOLLOWED = {**STARTED, **documented(404)}
"""The run that another one refers to."""


@dataclass(frozen=True, slots=True)
class Starter:
    """Starts the run of a request, and returns it."""

    runtime: Runtime
    response: Response
    idempotency_key: str | None = None

    def submit(self, request: CalibrationRequest, by: Actor) -> CalibrationSummary:
        """Start a run from a request."""
        orchestrator = self.runtime.orchestrator
        return self._answer(orchestrator.submit(request, idempotency_key=self.idempotency_key, by=by))

    def retract(self, operator: str, by: Actor) -> CalibrationSummary:
        """Start the return into the workspace."""
        orchestrator = self.runtime.orchestrator
        return self._answer(orchestrator.retract(operator, idempotency_key=self.idempotency_key, by=by))

    def follow(self, kind: str, calibration_id: int, operator: str, by: Actor) -> CalibrationSummary:
        """Start a run of this kind that refers to an earlier one."""
        submitted = self.runtime.orchestrator.follow(
            kind, calibration_id, operator, idempotency_key=self.idempotency_key, by=by
        )
        return self._answer(submitted)

    def _answer(self, submitted: Submitted) -> CalibrationSummary:
        """The run, with its address."""
        self.response.headers["Location"] = f"/api/v1/calibrations/{submitted.id}"
        return self.runtime.store.summary(submitted.id)


async def _with_key(
    runtime: TheRuntime, response: Response, idempotency_key: IdempotencyKey = None
) -> Starter:
    return Starter(runtime, response, idempotency_key)


async def _without_key(runtime: TheRuntime, response: Response) -> Starter:
    return Starter(runtime, response)


TheStarter = Annotated[Starter, Depends(_with_key)]
StarterWithoutKey = Annotated[Starter, Depends(_without_key)]
"""For requests that return the same run when repeated, with or without a key."""
Operating = Annotated[Actor, needs(Permission.OPERATE)]
