"""Finished runs as points of a trend: few columns of many runs."""

from __future__ import annotations

import sqlite3
from datetime import datetime

from station.records import TrendPoint
from station.store.kept_file import KeptFile
from station.store.rows import millis, moment


class Trends(KeptFile):
    """What process control asks for."""

    def trend(
        self,
        *,
        limit: int,
        robot_serial: str | None = None,
        robot_type: str | None = None,
        since: datetime | None = None,
        kinds: tuple[str, ...] = ("calibrate",),
    ) -> list[TrendPoint]:
        """The newest finished runs of these kinds, oldest first, at most `limit`.

        :param since: ended then or later; a time without a zone is UTC.
        """
        places = ", ".join("?" * len(kinds))
        conditions, values = [f"kind IN ({places})", "ended_ms IS NOT NULL"], [*kinds]
        bounds: list[int] = []
        for column, wanted in (("robot_serial", robot_serial), ("robot_type", robot_type)):
            if wanted is not None:
                conditions.append(f"{column} = ?")
                values.append(wanted)
        if since is not None:
            conditions.append("ended_ms >= ?")
            bounds.append(millis(since))
        rows = self._readers.all(
            "SELECT id, uid, robot_serial, kind, plan, state, verdict, outcome, reason_code, ended_ms,"
            " zero1_deg, zero1_sd_deg, zero2_deg, zero2_sd_deg, position_error_mm,"
            " json_extract(what, '$.software') AS software"
            " FROM calibrations LEFT JOIN results ON calibration_id = id LEFT JOIN made_by ON run_id = id"
            f" WHERE {' AND '.join(conditions)} ORDER BY id DESC LIMIT ?",
            [*values, *bounds, limit],
        )
        return [_point(row) for row in reversed(rows)]


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
