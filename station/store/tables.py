"""Finished runs, their readings and findings as plain columns, many at a time, for analysis elsewhere."""

from __future__ import annotations

from station.records import State
from station.store.kept_file import KeptFile

Columns = dict[str, tuple[object, ...]]
"""By name, all equally long."""

GROWING = ("calibrations", "readings", "results", "chain", "events", "audit", "happenings")
MIGRATIONS = "_sqlite_migrations"
"""Where the library keeps which steps were applied."""

RUNS = {
    "id": "id",
    "uid": "uid",
    "robot_serial": "robot_serial",
    "robot_type": "robot_type",
    "kind": "kind",
    "plan": "plan",
    "operator": "operator",
    "work_order": "work_order",
    "state": "state",
    "verdict": "verdict",
    "outcome": "outcome",
    "reason_code": "reason_code",
    "reason": "reason",
    "created_at": "created_ms",
    "started_at": "started_ms",
    "ended_at": "ended_ms",
    "dtheta1_deg": "zero1_deg",
    "dtheta1_sd_deg": "zero1_sd_deg",
    "dtheta2_deg": "zero2_deg",
    "dtheta2_sd_deg": "zero2_sd_deg",
    "position_error_mm": "position_error_mm",
}
SHARED = ("run_uid", "robot_serial", "created_at")
OF_ITS_RUN = {"id": "id", "run_uid": "uid", "robot_serial": "robot_serial", "created_at": "created_ms"}
"""Of a run, in each of its readings."""
READINGS = {
    "run_id": "calibration_id",
    "reading": "reading",
    "sequence": "walk",
    "t_s": "t_s",
    "theta1_deg": "theta1_deg",
    "theta2_deg": "theta2_deg",
    "approach1": "approach1",
    "approach2": "approach2",
    "scale_mm": "scale_mm",
    "position": "position",
    "temperature_c": "temperature_c",
    "payload_kg": "payload_kg",
    "mount": "mount",
}
FINDINGS = {
    "run_id": "calibration_id",
    "run_uid": "uid",
    "robot_serial": "robot_serial",
    "created_at": "created_ms",
    "effect": "json_extract(finding.value, '$.effect')",
    "joint": "json_extract(finding.value, '$.joint')",
    "part": "json_extract(finding.value, '$.part')",
    "probability": "json_extract(finding.value, '$.probability')",
    "p_value": "json_extract(finding.value, '$.p_value')",
    "parameter": "json_extract(parameter.value, '$.name')",
    "value": "json_extract(parameter.value, '$.value')",
    "sd": "json_extract(parameter.value, '$.sd')",
    "unit": "json_extract(parameter.value, '$.unit')",
}


class Tables(KeptFile):
    """Ranges of run numbers, both ends included."""

    def finished_after(self, run: int, most: int) -> list[tuple[int, int]]:
        """Number and creation (ms since 1970) of runs after `run`, as far as all have ended."""
        rows = self._readers.all(
            "SELECT id, created_ms, state FROM calibrations WHERE id > ? ORDER BY id LIMIT ?", [run, most]
        )
        out: list[tuple[int, int]] = []
        for row in rows:
            if not State(row["state"]).ended:
                break
            out.append((row["id"], row["created_ms"]))
        return out

    def runs_table(self, first: int, last: int) -> Columns:
        """One row a run, see `RUNS`; times in ms since 1970."""
        return self._columns(RUNS, "calibrations LEFT JOIN results ON calibration_id = id", "id", first, last)

    def readings_table(self, first: int, last: int) -> Columns:
        """One row a reading, see `READINGS`."""
        found = self._columns(READINGS, "readings", "calibration_id", first, last)
        # what all readings of a run share is fetched once a run
        runs = self._columns(OF_ITS_RUN, "calibrations", "id", first, last)
        of_run = dict(zip(runs["id"], zip(*(runs[name] for name in SHARED), strict=True), strict=True))
        shared = list(zip(*(of_run[run] for run in found["run_id"]), strict=True)) or [()] * len(SHARED)
        return {"run_id": found["run_id"], **dict(zip(SHARED, shared, strict=True)), **found}

    def findings_table(self, first: int, last: int) -> Columns:
        """One row a parameter of an effect that was found, see `FINDINGS`."""
        tables = (
            "results JOIN calibrations ON calibrations.id = calibration_id,"
            " json_each(result, '$.findings') finding, json_each(finding.value, '$.parameters') parameter"
        )
        return self._columns(FINDINGS, tables, "calibration_id", first, last)

    def counts(self) -> dict[str, int]:
        """Rows of every table that only grows, by its name."""
        found: dict[str, int] = {}
        for table in GROWING:
            row = self._readers.one(f"SELECT count(*) AS n FROM {table}")
            found[table] = 0 if row is None else int(row["n"])
        return found

    def schema_step(self) -> str:
        """The last step that brought the tables up to date."""
        row = self._readers.one(f"SELECT name FROM {MIGRATIONS} ORDER BY id DESC LIMIT 1")
        return "" if row is None else str(row["name"])

    def _columns(self, columns: dict[str, str], tables: str, run: str, first: int, last: int) -> Columns:
        shown = ", ".join(f"{source} AS {name}" for name, source in columns.items())
        found = self._readers.columns(
            f"SELECT {shown} FROM {tables} WHERE {run} BETWEEN ? AND ? ORDER BY {run}", [first, last]
        )
        return dict(zip(columns, found or [()] * len(columns), strict=True))
