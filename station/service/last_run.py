"""The last run as a page shows it, for those who did not watch it."""

from __future__ import annotations

from collections.abc import Callable

from station.records import CalibrationSummary, Reading, RunReading, RunStop, RunView
from station.store import Store

Place = Callable[[tuple[float, ...]], tuple[float, float] | None]
"""x, y in mm of joint angles in deg; None where the linkage does not close."""


def last_run(store: Store, last: CalibrationSummary, place: Place) -> RunView:
    """Its readings with their residuals, each as a position that is done, from the store."""
    residuals = {row.reading: row for row in store.calibration(last.id).residuals}

    def row(reading: Reading) -> RunReading:
        point, judged = place(reading.theta_deg), residuals.get(reading.reading)
        return RunReading(
            reading=reading.reading,
            position=reading.position,
            x_mm=point and point[0],
            y_mm=point and point[1],
            theta1_deg=reading.theta_deg[0],
            theta2_deg=reading.theta_deg[1],
            scale_mm=reading.scale_mm,
            t_s=reading.t_s,
            walk=reading.sequence,
            residual_mm=judged.residual_mm if judged else None,
            limit_mm=judged.limit_mm if judged else None,
        )

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
