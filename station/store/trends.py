"""Finished runs as points of a trend: few columns of many runs."""

from __future__ import annotations

from datetime import datetime

from pydantic import TypeAdapter

from station.records import EffectPoint, TrendPoint
from station.store.kept_file import KeptFile
from station.store.rows import millis, moment

_COLUMNS = {
    **{name: name for name in ("id", "uid", "robot_serial", "kind", "plan", "state")},
    **{name: name for name in ("verdict", "outcome", "reason_code")},
    "ended_at": "ended_ms",
    "dtheta1_deg": "zero1_deg",
    "dtheta1_sd_deg": "zero1_sd_deg",
    "dtheta2_deg": "zero2_deg",
    "dtheta2_sd_deg": "zero2_sd_deg",
    "position_error_mm": "position_error_mm",
    "software": "json_extract(what, '$.software')",
}
_POINTS = TypeAdapter(list[TrendPoint])
"""A thousand at once take a third of the time of single ones."""


class Trends(KeptFile):
    """Queries of process control."""

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
        finished, values = _finished(robot_serial, robot_type, since)
        places = ", ".join("?" * len(kinds))
        rows = self._readers.all(
            f"SELECT {', '.join(f'{source} AS {name}' for name, source in _COLUMNS.items())}"
            " FROM calibrations LEFT JOIN results ON calibration_id = id LEFT JOIN made_by ON run_id = id"
            f" WHERE kind IN ({places}) AND {finished} ORDER BY id DESC LIMIT ?",
            [*kinds, *values, limit],
        )
        found = [dict(zip(_COLUMNS, row, strict=True)) for row in reversed(rows)]
        for one in found:
            one["ended_at"] = moment(one["ended_at"])
        return _POINTS.validate_python(found)

    def effects(
        self,
        *,
        limit: int,
        robot_serial: str | None = None,
        robot_type: str | None = None,
        since: datetime | None = None,
    ) -> list[EffectPoint]:
        """Sizes of the effects that the newest finished runs found, oldest first; `limit` counts runs.

        :param since: ended then or later; a time without a zone is UTC.
        """
        finished, values = _finished(robot_serial, robot_type, since)
        rows = self._readers.all(
            f"WITH newest AS (SELECT id FROM calibrations WHERE {finished}"
            " ORDER BY id DESC LIMIT ?)"
            " SELECT newest.id AS run, effect, joint, part, parameter, unit, value, sd"
            " FROM newest JOIN findings ON calibration_id = newest.id"
            " WHERE n = 0 AND value IS NOT NULL ORDER BY run",
            [*values, limit],
        )
        return [EffectPoint(**{key: row[key] for key in row.keys()}) for row in rows]  # noqa: SIM118


def _finished(
    robot_serial: str | None, robot_type: str | None, since: datetime | None
) -> tuple[str, list[str | int]]:
    """Condition on finished runs, and its values."""
    conditions, values = ["ended_ms IS NOT NULL"], list[str | int]()
    for condition, wanted in (
        ("robot_serial = ?", robot_serial),
        ("robot_type = ?", robot_type),
        ("ended_ms >= ?", None if since is None else millis(since)),
    ):
        if wanted is not None:
            conditions.append(condition)
            values.append(wanted)
    return " AND ".join(conditions), values
