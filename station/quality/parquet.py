"""The history as Parquet files in partitions, station by station and month by month; again: only what is new.

`runs/station=NAME/month=YYYY-MM/*.parquet`, likewise `readings/` and `findings/`.  A file holds the runs that
its name says.  Files of runs are written last: they say how far an export came.
"""

from __future__ import annotations

import gc
import re
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from functools import partial
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from station.errors import InputRefused
from station.records import Record
from station.store import Columns, Store

if TYPE_CHECKING:
    import pyarrow as pa

SCHEMA = "station.export/1"
RUNS_AT_ONCE = 2000
TABLES = ("findings", "readings", "runs")
_FILE = re.compile(r"runs-(\d+)-(\d+)\.parquet")
_TEXT = {
    "uid", "robot_serial", "robot_type", "kind", "plan", "operator", "work_order", "state", "verdict",
    "outcome", "reason_code", "reason", "run_uid", "position", "mount", "effect", "part", "parameter", "unit",
}  # fmt: skip
_WHOLE = {"id", "run_id", "reading", "sequence", "approach1", "approach2", "joint"}
_TIMES = {"created_at", "started_at", "ended_at"}


class Exported(Record):
    """What was written."""

    runs: int
    readings: int
    findings: int
    last: int
    """Number of the last run that the folder holds."""


def export_parquet(store: Store, folder: Path, station: str, progress: Callable[[int], None]) -> Exported:
    """Every finished run that the folder does not hold yet, in the order of their numbers.

    A run that has not ended holds back those after it.

    :param progress: told how many runs were written, now and then
    :raises InputRefused: pyarrow is not installed, or the folder cannot be written
    """
    try:
        import pyarrow.parquet  # noqa: F401  (heavy, and wanted by this alone)
    except ImportError as error:
        raise InputRefused("Parquet files need pyarrow; install `fivebar-station[quality]`.") from error
    name = f"station={quote(station, safe='')}"
    collected = gc.isenabled()
    try:
        # millions of rows pass through, none in a circle: looking for circles takes a third of the time
        gc.disable()
        last = _last_run(folder / "runs" / name)
        _remove_after(folder, name, last)
        written = dict.fromkeys(TABLES, 0)
        while found := store.finished_after(last, RUNS_AT_ONCE):
            month = _month(found[0][1])
            # a file holds runs of one month, so that a batch is whole or not there
            runs = [run for run, _ in takewhile(partial(_made_in, month), found)]
            first, last = runs[0], runs[-1]
            for table, columns in (
                ("findings", store.findings_table(first, last)),
                ("readings", store.readings_table(first, last)),
                ("runs", store.runs_table(first, last)),
            ):
                if columns["created_at"]:
                    file = folder / table / name / f"month={month}" / f"runs-{first}-{last}.parquet"
                    _write(_table(columns), file)
                    written[table] += len(columns["created_at"])
            progress(len(runs))
    except OSError as error:
        raise InputRefused(f"{folder} cannot be written: {error.strerror or error}.") from error
    finally:
        if collected:
            gc.enable()
    return Exported(**written, last=last)


def _files(folder: Path) -> Iterator[tuple[Path, int, int]]:
    """Files of a partition with the first and last run that each may hold."""
    for file in sorted(folder.glob("month=*/*.parquet")):
        if found := _FILE.fullmatch(file.name):
            yield file, int(found[1]), int(found[2])


def _last_run(folder: Path) -> int:
    return max((last for _, _, last in _files(folder)), default=0)


def _remove_after(folder: Path, name: str, last: int) -> None:
    """What an export that was cut off left of runs whose own file it did not write."""
    for table in TABLES[:-1]:
        for file, first, _ in _files(folder / table / name):
            if first > last:
                file.unlink()


def _table(columns: Columns) -> pa.Table:
    import pyarrow as pa

    types = {
        name: pa.string()
        if name in _TEXT
        else pa.int64()
        if name in _WHOLE
        else pa.timestamp("ms", tz="UTC")
        if name in _TIMES
        else pa.float64()
        for name in columns
    }
    table = pa.table({name: pa.array(values, types[name]) for name, values in columns.items()})
    return table.replace_schema_metadata({"schema": SCHEMA})


def _made_in(month: str, run: tuple[int, int]) -> bool:
    return _month(run[1]) == month


def _month(created_ms: int) -> str:
    """UTC, by creation of the run."""
    return datetime.fromtimestamp(created_ms / 1000, UTC).strftime("%Y-%m")


def _write(table: pa.Table, file: Path) -> None:
    """Whole or not at all."""
    from pyarrow import parquet

    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_suffix(".part")
    parquet.write_table(table, part, compression="zstd")
    part.rename(file)
