"""The history as Parquet files in partitions, by station and by month; a repeated export adds only new runs.

`runs/station=NAME/month=YYYY-MM/*.parquet`, likewise `readings/` and `findings/`.  A file contains the runs
in its name. Files of runs are written last: they mark the progress of an export.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING, Literal
from urllib.parse import quote

from station.errors import InputRefused
from station.records import Record
from station.store import Columns, Store

if TYPE_CHECKING:
    import pyarrow as pa

SCHEMA = "station.export/1"
RUNS_AT_ONCE = 2000
Exportable = Literal["findings", "readings", "runs"]
TABLES: tuple[Exportable, ...] = ("findings", "readings", "runs")
_FILE = re.compile(r"runs-(\d+)-(\d+)\.parquet")
_TEXT = {
    "uid", "robot_serial", "robot_type", "kind", "plan", "operator", "work_order", "state", "verdict",
    "outcome", "reason_code", "reason", "run_uid", "position", "mount", "effect", "part", "parameter", "unit",
}  # fmt: skip
_WHOLE = {"id", "run_id", "reading", "sequence", "approach1", "approach2", "joint"}
_TIMES = {"created_at", "started_at", "ended_at"}


class Exported(Record):
    """The result of an export."""

    runs: int
    readings: int
    findings: int
    last: int
    """Number of the last run in the folder."""


def export_parquet(store: Store, folder: Path, station: str, progress: Callable[[int], None]) -> Exported:
    """Export every finished run that the folder does not contain yet, in the order of their numbers.

    A run that has not ended holds back those after it.

    :param progress: receives the number of runs written, at intervals
    :raises InputRefused: pyarrow is not installed, or the folder cannot be written
    """
    try:
        import pyarrow.parquet  # noqa: F401  (heavy, and wanted by this alone)
    except ImportError as error:
        raise InputRefused("Parquet files need pyarrow; install `fivebar-station[quality]`.") from error
    name = f"station={quote(station, safe='')}"
    try:
        last = _last_run(folder / "runs" / name)
        _remove_after(folder, name, last)
        written = dict.fromkeys(TABLES, 0)
        while found := store.finished_after(last, RUNS_AT_ONCE):
            # a file contains runs of one month, so that a batch is complete or absent
            month, of_month = next(groupby(found, key=itemgetter(1)))
            runs = [run for run, _ in of_month]
            first, last = runs[0], runs[-1]
            of_runs = _table(store.table("run_of_each", first, last))
            for name_of_table in TABLES:
                table = _table(store.table(name_of_table, first, last))
                if name_of_table != "runs":
                    table = _with_run(table, of_runs)
                if table.num_rows:
                    file = folder / name_of_table / name / f"month={month}" / f"runs-{first}-{last}.parquet"
                    _write(table, file)
                    written[name_of_table] += table.num_rows
            progress(len(runs))
    except OSError as error:
        raise InputRefused(f"{folder} cannot be written: {error.strerror or error}.") from error
    return Exported(**written, last=last)


def _files(folder: Path) -> Iterator[tuple[Path, int, int]]:
    """Files of a partition with the first and last run that each may contain."""
    for file in sorted(folder.glob("month=*/*.parquet")):
        if found := _FILE.fullmatch(file.name):
            yield file, int(found[1]), int(found[2])


def _last_run(folder: Path) -> int:
    return max((last for _, _, last in _files(folder)), default=0)


def _remove_after(folder: Path, name: str, last: int) -> None:
    """Remove the files that an interrupted export left for runs without a file of their own."""
    for table in TABLES[:-1]:
        for file, first, _ in _files(folder / table / name):
            if first > last:
                file.unlink()


def _table(parts: Iterable[Columns]) -> pa.Table:
    """A table; without columns if there are no rows."""
    import pyarrow as pa

    tables = [
        pa.table({name: pa.array(values, _type(name)) for name, values in columns.items()})
        for columns in parts
    ]
    return pa.concat_tables(tables) if tables else pa.table({})


def _type(column: str) -> pa.DataType:
    import pyarrow as pa

    if column in _TEXT:
        return pa.string()
    if column in _WHOLE:
        return pa.int64()
    return pa.timestamp("ms", tz="UTC") if column in _TIMES else pa.float64()


def _with_run(table: pa.Table, of_runs: pa.Table) -> pa.Table:
    """Add the columns that all rows of a run share after its number."""
    import pyarrow as pa
    from pyarrow import compute

    if not table.num_rows:
        return table
    run = of_runs.take(compute.index_in(table["run_id"], of_runs["run_id"].combine_chunks()))
    own = {name: table[name] for name in table.column_names}
    return pa.table({**{name: run[name] for name in of_runs.column_names}, **own})


def _write(table: pa.Table, file: Path) -> None:
    """Write atomically."""
    from pyarrow import parquet

    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_suffix(".part")
    parquet.write_table(table.replace_schema_metadata({"schema": SCHEMA}), part, compression="zstd")
    part.rename(file)
