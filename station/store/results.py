"""Storage of a run's results: the whole as JSON, and values queried across runs in columns and rows."""

from __future__ import annotations

from sqlite_utils import Database

from station.records import CalibrationResult
from station.store.migrations import INSERT_FINDINGS
from station.store.rows import pack_document, result_row


def keep_result(db: Database, run: int, result: CalibrationResult) -> None:
    """Store a result in the transaction that ends the run."""
    db.execute(
        "INSERT INTO results (calibration_id, zero1_deg, zero1_sd_deg, zero2_deg, zero2_sd_deg,"
        " position_error_mm, result, diagnosis) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        [run, *result_row(result), pack_document(result.diagnosis)],
    )
    if result.findings:
        db.execute(f"{INSERT_FINDINGS} WHERE calibration_id = ?", [run])
