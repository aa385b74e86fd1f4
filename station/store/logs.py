"""Logs of other machines as they were given, and what was found in them."""

from __future__ import annotations

import zlib

from station.records import ImportedLog, KeptLog, LogDocuments
from station.store.kept_file import KeptFile


class Logs(KeptFile):
    """Files are kept to the byte, so that nothing that somebody measured is lost in reading them."""

    def keep_log(self, run: int, log: ImportedLog) -> None:
        """Once, when the run is created; they become a part of the run's record."""
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
        """What is learned from first; empty for a run that has none."""
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
