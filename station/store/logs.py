"""Logs of other machines as received, and the results of their diagnosis."""

from __future__ import annotations

import zlib

from station.records import ImportedLog, KeptLog, LogDocuments
from station.store.kept_file import KeptFile


class Logs(KeptFile):
    """Files are stored to the byte, so that no measured data are lost by reading them."""

    def keep_log(self, run: int, log: ImportedLog) -> None:
        """Called once, when the run is created; the logs become part of the run's record."""
        with self._writing() as db:
            db.conn.executemany(
                "INSERT INTO logs (run_id, part, name, columns, measured, content) VALUES (?, ?, ?, ?, ?, ?)",
                [
                    (run, file.part, file.name, file.columns, file.measured, zlib.compress(file.content, 9))
                    for file in log.files
                ],
            )
            packed = [
                zlib.compress(text.encode(), 9) for text in (log.documents.residuals, log.documents.report)
            ]
            db.execute(
                "INSERT INTO log_documents (run_id, residuals, report) VALUES (?, ?, ?)", [run, *packed]
            )
            db.execute(
                "UPDATE calibrations SET step = ?, steps = ? WHERE id = ?", [log.readings, log.readings, run]
            )

    def logs_of(self, run: int) -> list[KeptLog]:
        """The logs of a run, the one to learn from first; empty for a run without logs."""
        rows = self._readers.all(
            "SELECT part, name, columns, measured, content FROM logs WHERE run_id = ? ORDER BY part", [run]
        )
        return [
            KeptLog(
                row["part"], row["name"], zlib.decompress(row["content"]), row["columns"], row["measured"]
            )
            for row in rows
        ]

    def log_documents(self, run: int) -> LogDocuments | None:
        """None for a run that was not made from a log."""
        row = self._readers.one("SELECT residuals, report FROM log_documents WHERE run_id = ?", [run])
        return (
            None
            if row is None
            else LogDocuments(*(zlib.decompress(row[name]).decode() for name in ("residuals", "report")))
        )
