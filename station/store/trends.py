"""Finished runs as points of a trend: few columns of many runs."""

from __future__ import annotations

import sqlite3
from datetime import datetime

from station.records import EffectPoint, TrendPoint
from station.store.kept_file import KeptFile
from station.store.rows import millis, moment

POSITION_ERROR = """CASE WHEN json_extract(result, '$.after.fresh_reading_rms_mm') IS NOT NULL THEN coalesce(
    json_extract(result, '$.accuracy.bound_95_mm'),
    json_extract(result, '$.after.predicted_position_error_mm.bound_95'),
    json_extract(result, '$.after.predicted_position_error_mm.max')) END"""


class Trends(KeptFile):
    """What process control asks for."""

    def trend(
        self,
        *,
        limit: int,
        robot_serial: str | None = None,
        since: datetime | None = None,
        kinds: tuple[str, ...] = ("calibrate",),
    ) -> list[TrendPoint]:
        """The newest finished runs of these kinds, oldest first, at most `limit`.

        :param since: ended then or later; a time without a zone is UTC.
        """
        places = ", ".join("?" * len(kinds))
        conditions, values = [f"kind IN ({places})", "ended_ms IS NOT NULL"], [*kinds]
        bounds: list[int] = []
        if robot_serial is not None:
            conditions.append("robot_serial = ?")
            values.append(robot_serial)
        if since is not None:
            conditions.append("ended_ms >= ?")
            bounds.append(millis(since))
        rows = self._readers.all(
            "SELECT id, uid, robot_serial, kind, plan, state, verdict, outcome, reason_code, ended_ms,"
            f" zero1_deg, zero1_sd_deg, zero2_deg, zero2_sd_deg, {POSITION_ERROR} AS position_error_mm,"
            " json_extract(what, '$.software') AS software"
            " FROM calibrations LEFT JOIN results ON calibration_id = id LEFT JOIN made_by ON run_id = id"
            f" WHERE {' AND '.join(conditions)} ORDER BY id DESC LIMIT ?",
            [*values, *bounds, limit],
        )
        return [_point(row) for row in reversed(rows)]

    def effects(
        self, *, limit: int, robot_serial: str | None = None, since: datetime | None = None
    ) -> list[EffectPoint]:
        """Sizes of the effects that the newest finished runs found, oldest first; `limit` counts runs.

        :param since: ended then or later; a time without a zone is UTC.
        """
        conditions: list[str] = ["ended_ms IS NOT NULL"]
        values: list[str | int] = []
        if robot_serial is not None:
            conditions.append("robot_serial = ?")
            values.append(robot_serial)
        if since is not None:
            conditions.append("ended_ms >= ?")
            values.append(millis(since))
        rows = self._readers.all(
            f"WITH newest AS (SELECT id FROM calibrations WHERE {' AND '.join(conditions)}"
            " ORDER BY id DESC LIMIT ?)"
            " SELECT newest.id AS run, finding.value ->> '$.effect' AS effect,"
            " finding.value ->> '$.joint' AS joint, finding.value ->> '$.part' AS part,"
            " finding.value ->> '$.parameters[0].name' AS parameter,"
            " finding.value ->> '$.parameters[0].unit' AS unit,"
            " finding.value ->> '$.parameters[0].value' AS value,"
            " finding.value ->> '$.parameters[0].sd' AS sd"
            " FROM newest JOIN results ON calibration_id = newest.id, json_each(result, '$.findings') finding"
            " WHERE finding.value ->> '$.parameters[0].value' IS NOT NULL ORDER BY run",
            [*values, limit],
        )
        return [EffectPoint(**{key: row[key] for key in row.keys()}) for row in rows]  # noqa: SIM118


def _point(row: sqlite3.Row) -> TrendPoint:
    same = ("id", "uid", "robot_serial", "kind", "plan", "state", "verdict", "outcome", "reason_code")
    return TrendPoint(
        **{key: row[key] for key in same},
        ended_at=moment(row["ended_ms"]),
        dtheta1_deg=row["zero1_deg"],
        dtheta1_sd_deg=row["zero1_sd_deg"],
        dtheta2_deg=row["zero2_deg"],
        dtheta2_sd_deg=row["zero2_sd_deg"],
        position_error_mm=row["position_error_mm"],
        software=row["software"],
    )
