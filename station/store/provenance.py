"""Software and devices of each run, stored when the run is created."""

from __future__ import annotations

from station.records import MadeBy
from station.store.chain import Chained, chained
from station.store.kept_file import KeptFile


class Provenance(KeptFile):
    """Software, devices and scale certificate of a run."""

    def keep_made_by(self, run: int, made_by: MadeBy) -> None:
        """Called once; it becomes a part of the run's record."""
        with self._writing() as db:
            db.execute("INSERT INTO made_by (run_id, what) VALUES (?, ?)", [run, made_by.model_dump_json()])

    def made_by(self, run: int) -> MadeBy | None:
        """None for a run of an earlier version, and for one that was measured elsewhere."""
        row = self._readers.one("SELECT what FROM made_by WHERE run_id = ?", [run])
        return None if row is None else MadeBy.model_validate_json(row["what"])

    def chained(self, run: int) -> Chained | None:
        """The record of a finished run with its link; None for one that ended before there was a chain.

        :raises NotFound: no such run.
        """
        return chained(self._readers.all, run)
