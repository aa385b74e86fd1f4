"""The last run for the page, for users who did not watch it."""

from __future__ import annotations

from collections.abc import Callable

from station.records import CalibrationSummary, Reading, RunReading, RunStop, RunView
from station.service.run import Place, row_of
from station.store import Store

PlaceOf = Callable[[tuple[float, ...]], Place]
"""x, y in mm of joint angles in deg; None where the linkage does not close."""


def last_run(store: Store, last: CalibrationSummary, place: PlaceOf) -> RunView:
    """Its readings with their residuals, each as a completed position, from the store."""
    residuals = {row.reading: row for row in store.calibration(last.id).residuals}

    def row(reading: Reading) -> RunReading:
        shown = row_of(reading, place(reading.theta_deg))
        judged = residuals.get(reading.reading)
        found = {"residual_mm": judged.residual_mm, "limit_mm": judged.limit_mm} if judged else {}
        return shown.model_copy(update=found)

    readings = tuple(map(row, store.readings(last.id)))
    return RunView(
        id=last.id,
        uid=last.uid,
        state=last.state,
        robot_serial=last.robot_serial,
        kind=last.kind,
        plan=last.plan,
        of=last.of,
        operator=last.operator,
        work_order=last.work_order,
        started_at=last.started_at,
        progress=1.0,
        step=last.step,
        steps=last.steps,
        stops=tuple(
            RunStop(position=r.position, x_mm=r.x_mm, y_mm=r.y_mm, done=True)
            for r in readings
            if r.x_mm is not None and r.y_mm is not None
        ),
        readings=readings,
    )
