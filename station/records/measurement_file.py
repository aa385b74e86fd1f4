"""The measurement file of the contract: CSV, UTF-8, header row, decimal point.

Reading it either gives valid arrays or raises `InputRefused` with the row, the column and the remedy; nothing
is guessed and nothing is skipped.
"""

from __future__ import annotations

import csv
import io
import logging
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from station.errors import InputRefused
from station.records.csv_cells import harmless
from station.records.files import content_of
from station.records.measurements import Measurements, number
from station.records.reading import Reading
from station.records.types import LARGEST_ID, Real

log = logging.getLogger(__name__)

MINIMUM_READINGS = 5
"""Four unknowns and the reading offset (paper, section 5: K >= 5)."""
LARGEST_NUMBER = 1e12
"""Limit for any unit, also seconds since 1970; its square is still finite."""


@dataclass(frozen=True, slots=True)
class Columns:
    """Required and optional columns of a mechanism's file."""

    joints: int = 2
    distance: str = "scale_mm"
    """Distance column; required, unless `either`."""
    tracker: tuple[str, ...] = ("tracker_x_mm", "tracker_y_mm")
    either: bool = False
    """Whether the position columns may replace the distance."""
    time_ordered: bool = True
    """The station writes rows in time order: one out of order is a fault. Logs of other machines may jump."""
    sliding: tuple[int, ...] = ()
    """Joints that slide, counted from 1."""
    more: tuple[str, ...] = ()
    """Further optional columns."""

    @property
    def theta(self) -> tuple[str, ...]:
        joints = range(1, self.joints + 1)
        return tuple(f"travel{i}_mm" if i in self.sliding else f"theta{i}_deg" for i in joints)

    @property
    def to_internal(self) -> Real:
        """(n,) factors of the joint columns: to rad, and to m for sliding joints."""
        joints = range(1, self.joints + 1)
        return np.array([1e-3 if i in self.sliding else np.radians(1.0) for i in joints])

    @property
    def approach(self) -> tuple[str, ...]:
        return tuple(f"approach{i + 1}" for i in range(self.joints))

    @property
    def required(self) -> tuple[str, ...]:
        return ("reading", "t_s", *self.theta, *([] if self.either else [self.distance]))

    @property
    def optional(self) -> tuple[str, ...]:
        often = (
            *self.approach,
            "position",
            "temperature_c",
            "payload_kg",
            "mount",
            *self.tracker,
            *self.more,
        )
        return (*often, self.distance) if self.either else often


FIVE_BAR = Columns()


class Table:
    """The cells of one file, with refusals that state the position."""

    def __init__(self, source: str, header: list[str], rows: list[list[str]], lines: list[int]) -> None:
        self.source = source
        self.header = header
        self.rows = rows
        self.lines = lines

    def refuse(self, row: int, column: str, what: str) -> InputRefused:
        return InputRefused(f"{self.source}: row {self.lines[row]}, column {column}: {what}")

    def has(self, column: str) -> bool:
        return column in self.header

    def text(self, column: str) -> list[str]:
        i = self.header.index(column)
        return [row[i].strip() for row in self.rows]

    def numbers(self, column: str) -> Real:
        values = np.empty(len(self.rows))
        for k, cell in enumerate(self.text(column)):
            try:
                values[k] = float(cell)
            except ValueError:
                what = "is empty; fill it or remove the row." if not cell else f"{cell!r} is not a number."
                raise self.refuse(k, column, what) from None
            if not math.isfinite(values[k]):
                raise self.refuse(k, column, f"{cell} is not a finite number; remove or repeat the reading.")
            if abs(values[k]) > LARGEST_NUMBER:
                raise self.refuse(k, column, f"{cell} is beyond anything that is measured; check the column.")
        return values

    def optional_numbers(self, column: str) -> Real | None:
        """None if the column is missing or empty throughout."""
        if not self.has(column) or not any(self.text(column)):
            return None
        return self.numbers(column)


def read_measurements(path: Path, columns: Columns = FIVE_BAR) -> Measurements:
    """Read a measurement file.

    :raises InputRefused: the file is malformed; the error gives row, column and remedy.
    """
    return parse_measurements(content_of(path), columns, source=path.name)


def parse_measurements(
    content: bytes, columns: Columns = FIVE_BAR, *, source: str = "measurement file"
) -> Measurements:
    """The same from the file's bytes (an upload).  :raises InputRefused:"""
    return _measurements(read_table(content, columns.required, columns.optional, source), columns)


def recorded_columns(content: bytes) -> set[str]:
    """Columns with content, of a measurement file that was read without an error."""
    header, *rows = [row for row in csv.reader(io.StringIO(content.decode("utf-8-sig"))) if any(row)]
    return {name.strip() for i, name in enumerate(header) if any(row[i].strip() for row in rows)}


def parse_readings(
    content: bytes,
    *,
    sequence: int = 1,
    after: int = 0,
    source: str = "measurement file",
    in_order: bool = True,
) -> list[Reading]:
    """The file's rows as records of a sequence, as the store keeps them.

    Ids that are whole numbers increasing from above `after` are retained; otherwise rows are numbered from
    there.

    :param in_order: refuse decreasing times; otherwise the caller checks the column
    :raises InputRefused: as `parse`.
    """
    table = read_table(content, FIVE_BAR.required, FIVE_BAR.optional, source)
    m = _measurements(table, replace(FIVE_BAR, time_ordered=in_order))
    own = [i for i in m.ids if isinstance(i, int)]
    rising = len(own) == len(m) and all(a < b for a, b in pairwise((after, *own))) and own[-1] <= LARGEST_ID
    ids = own if rising else range(after + 1, after + len(m) + 1)
    places = table.text("position") if table.has("position") else [""] * len(m)
    degrees = np.degrees(m.theta)
    return [
        Reading(
            reading=ids[k],
            t_s=float(m.t_s[k]),
            theta_deg=(float(degrees[k, 0]), float(degrees[k, 1])),
            approach=(int(m.approach[k, 0]), int(m.approach[k, 1])),
            scale_mm=float(m.distance[k]),
            position=places[k] or f"row {table.lines[k]}",
            sequence=sequence,
            temperature_c=None if m.temperature_c is None else float(m.temperature_c[k]),
            payload_kg=None if m.payload_kg is None else float(m.payload_kg[k]),
            mount=m.mounts[m.mount[k]] or None,
        )
        for k in range(len(m))
    ]


def _measurements(table: Table, columns: Columns) -> Measurements:
    """Measurements with every row checked. :raises InputRefused:"""
    ids = _ids(table)
    t_s = table.numbers("t_s")
    backwards = np.flatnonzero(np.diff(t_s) < 0)
    if columns.time_ordered and backwards.size:
        raise table.refuse(
            int(backwards[0]) + 1, "t_s", "time runs backwards; put the rows in the order they were measured."
        )
    joints = np.column_stack([table.numbers(name) for name in columns.theta])
    mount, mounts = number(table.text("mount") if table.has("mount") else [""] * len(ids))
    setup, setups = number(table.text("setup") if table.has("setup") else [""] * len(ids))
    place = table.text("position") if table.has("position") else [""] * len(ids)
    # a reading without a position label is a position of its own
    position = number([label or f"\0{k}" for k, label in enumerate(place)])[0]
    measurements = Measurements(
        ids=ids,
        t_s=t_s,
        theta=joints * columns.to_internal,
        approach=np.column_stack([approaches(table, name) for name in columns.approach]).astype(np.int8),
        distance=_distance(table, columns),
        position=position,
        mount=mount,
        samples=np.ones(len(ids), dtype=np.intp),
        mounts=tuple(str(m) for m in mounts),
        setup=setup if len(setups) > 1 else None,
        setups=tuple(str(s) for s in setups),
        sliding=columns.sliding,
        temperature_c=table.optional_numbers("temperature_c"),
        payload_kg=table.optional_numbers("payload_kg"),
        tracker=_tracker(table, columns),
    )
    if len(measurements) < MINIMUM_READINGS:
        raise InputRefused(
            f"{table.source}: only {len(measurements)} readings; at least {MINIMUM_READINGS} at different "
            "places are needed to identify anything."
        )
    return measurements


def read_table(content: bytes, required: Sequence[str], optional: Sequence[str], source: str) -> Table:
    """The cells of a CSV file with a header.  :raises InputRefused: the file is not one."""
    if not content.strip():
        raise InputRefused(f"{source} is empty; a header row and readings are needed.")
    if b"\0" in content:
        raise InputRefused(f"{source} is not a text file; a CSV file in UTF-8 is needed.")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise InputRefused(
            f"{source}: row {line} is not UTF-8 text; save the file as CSV in UTF-8."
        ) from error
    reader = csv.reader(io.StringIO(text), strict=True)
    header: list[str] = []
    rows: list[list[str]] = []
    lines: list[int] = []
    try:
        for row in reader:
            if not any(cell.strip() for cell in row):
                continue
            if not header:
                header = [name.strip() for name in row]
                _check_header(header, required, optional, source)
            else:
                if len(row) != len(header):
                    raise InputRefused(
                        f"{source}: row {reader.line_num} has {len(row)} fields where the header has "
                        f"{len(header)}; the file is truncated or a separator is wrong."
                    )
                rows.append(row)
                lines.append(reader.line_num)
    except csv.Error as error:
        raise InputRefused(f"{source}: row {reader.line_num} is not valid CSV: {error}.") from error
    if not rows:
        raise InputRefused(f"{source} has a header and no readings.")
    return Table(source, header, rows, lines)


def _check_header(header: list[str], required: Sequence[str], optional: Sequence[str], source: str) -> None:
    missing = [name for name in required if name not in header]
    if missing:
        if len(header) == 1 and any(mark in header[0] for mark in ";\t|"):
            raise InputRefused(
                f"{source}: row 1: columns must be separated by commas, with `.` as decimal point."
            )
        raise InputRefused(
            f"{source}: row 1: column {', '.join(missing)} is missing; required are {', '.join(required)}."
        )
    twice = {name for name in header if name and header.count(name) > 1}
    if twice:
        raise InputRefused(f"{source}: row 1: column {', '.join(sorted(twice))} appears twice.")
    unknown = [name for name in header if name not in (*required, *optional, RUN_UID)]
    if unknown:
        log.warning("%s: column %s is not known and is ignored.", source, ", ".join(unknown))


def _ids(table: Table) -> tuple[int | str, ...]:
    seen: dict[str, int] = {}
    for k, cell in enumerate(table.text("reading")):
        if not cell:
            raise table.refuse(k, "reading", "is empty; every reading needs an id.")
        if cell in seen:
            raise table.refuse(k, "reading", f"id {cell} was used in row {table.lines[seen[cell]]} already.")
        seen[cell] = k
    return tuple(int(cell) if cell.isascii() and cell.isdigit() else cell for cell in seen)


def _distance(table: Table, columns: Columns) -> Real:
    """(K,) mm; NaN where positions replace it. :raises InputRefused: both are missing."""
    if not columns.either or table.has(columns.distance):
        return table.numbers(columns.distance)
    if not all(table.has(name) for name in columns.tracker):
        raise InputRefused(
            f"{table.source}: row 1: nothing measured; columns {', '.join(columns.tracker)} or "
            f"{columns.distance} are needed."
        )
    return np.full(len(table.rows), np.nan)


def _tracker(table: Table, columns: Columns) -> Real | None:
    axes = [values for name in columns.tracker if (values := table.optional_numbers(name)) is not None]
    return np.column_stack(axes) if len(axes) == len(columns.tracker) else None


def approaches(table: Table, column: str) -> Real:
    """(K,) -1, 0 or 1; zeros if there is no such column.  :raises InputRefused:"""
    if not table.has(column):
        return np.zeros(len(table.rows))
    values = np.zeros(len(table.rows))
    for k, cell in enumerate(table.text(column)):
        if cell not in ("", "-1", "0", "1", "+1"):
            raise table.refuse(k, column, f"{cell!r} is not a direction; use -1, 0 (unknown) or 1.")
        values[k] = int(cell or 0)
    return values


RUN_UID = "run_uid"
"""Column with the run's identity in each row of an export; it has no effect when the file is read."""
HEADER = (
    "reading", "t_s", "theta1_deg", "theta2_deg", "approach1", "approach2", "scale_mm", "position",
    "temperature_c", "payload_kg", "mount", RUN_UID,
)  # fmt: skip


def readings_to_csv(readings: Iterable[Reading], *, run_uid: str | None = None) -> str:
    """The readings of a run as a measurement file; optional columns only if they have content.

    :param run_uid: identity of the run, for a file that leaves the station
    """
    rows: list[Sequence[object]] = [
        (
            r.reading, f"{r.t_s:.3f}", f"{r.theta_deg[0]:.6f}", f"{r.theta_deg[1]:.6f}", *r.approach,
            f"{r.scale_mm:.5f}", harmless(r.position), r.temperature_c, r.payload_kg,
            r.mount and harmless(r.mount), run_uid,
        )
        for r in readings
    ]  # fmt: skip
    kept = [i for i in range(len(HEADER)) if i < 8 or any(row[i] is not None for row in rows)]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([HEADER[i] for i in kept])
    writer.writerows([["" if row[i] is None else row[i] for i in kept] for row in rows])
    return out.getvalue()
