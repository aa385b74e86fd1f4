"""The chain of records: every finished run is hashed together with the hash of the run that ended before it.

Changing, removing or adding a finished run breaks the chain from there on, unless all later hashes are
recomputed; a copy of the last hash stored elsewhere reveals that too. A record is canonical JSON (RFC 8785),
so that another program can reproduce it. The single samples and the wire log are included by separate hashes,
since retention may delete them.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import rfc8785

Ask = Callable[[str, Sequence[Any]], Sequence[Sequence[Any]]]
"""SQL and its values to rows."""

_RUN = (
    "uid", "id", "robot_serial", "kind", "plan", "operator", "work_order", "metadata", "of_id", "state",
    "verdict", "outcome", "reason", "reason_code", "reason_params", "step", "steps", "created_ms",
    "started_ms", "ended_ms",
)  # fmt: skip
_READING = (
    "reading", "walk", "t_s", "theta1_deg", "theta2_deg", "approach1", "approach2", "scale_mm", "position",
    "temperature_c", "payload_kg", "mount",
)  # fmt: skip
_LOG = ("part", "name", "columns", "measured")
_START = ""
"""Substitute for the hash before the first one."""


@dataclass(frozen=True, slots=True)
class Broken:
    """The first run that differs from its record."""

    id: int
    uid: str
    why: str


@dataclass(frozen=True, slots=True)
class Verified:
    """The result of checking the whole chain."""

    runs: int
    """Number of unchanged runs in the chain, up to the first changed one."""
    older: int
    """Finished runs from before the station made a chain."""
    head: str
    """Hash of the last unchanged run."""
    broken: Broken | None


@dataclass(frozen=True, slots=True)
class Chained:
    """The record of one finished run and its link in the chain."""

    record: dict[str, Any]
    previous: str
    hash: str


def chained(ask: Ask, run: int) -> Chained | None:
    """The record as stored now; None if the run is not in the chain."""
    links = ask("SELECT n, samples_sha256, wire_sha256, hash FROM chain WHERE run_id = ?", [run])
    if not links:
        return None
    ((n, samples, wire, link),) = links
    before = ask("SELECT hash FROM chain WHERE n < ? ORDER BY n DESC LIMIT 1", [n])
    return Chained(record_of(ask, run, samples, wire), before[0][0] if before else _START, link)


def append(ask: Ask, run: int) -> None:
    """Add a run that has just ended to the chain, in the same transaction."""
    previous = next((row[0] for row in ask("SELECT hash FROM chain ORDER BY n DESC LIMIT 1", [])), _START)
    samples, wire = samples_hash(ask, run), wire_hash(ask, run)
    record = record_of(ask, run, samples, wire)
    ask(
        "INSERT INTO chain (run_id, uid, samples_sha256, wire_sha256, hash) VALUES (?, ?, ?, ?, ?)",
        [run, record["uid"], samples, wire, link_hash(previous, record)],
    )


def verify(ask: Ask) -> Verified:
    """Recompute every record and compare, in the order in which the runs ended."""
    links = ask("SELECT run_id, uid, samples_sha256, wire_sha256, hash FROM chain ORDER BY n", [])
    first = min((link[0] for link in links), default=None)
    ended = "state NOT IN ('queued', 'running', 'waiting')"
    (older,) = ask(f"SELECT count(*) FROM calibrations WHERE {ended} AND (? IS NULL OR id < ?)", [first] * 2)[
        0
    ]
    head = _START
    for count, (run, uid, samples, wire, expected) in enumerate(links):
        if why := _broken(ask, run, samples, wire, head, expected):
            return Verified(count, older, head, Broken(run, uid, why))
        head = expected
    loose = ask(
        f"SELECT id, uid FROM calibrations WHERE {ended} AND id >= ?"
        " AND id NOT IN (SELECT run_id FROM chain) ORDER BY id LIMIT 1",
        [first],
    )
    broken = next((Broken(run, uid, "it is not in the chain") for run, uid in loose), None)
    return Verified(len(links), older, head, broken)


def record_of(ask: Ask, run: int, samples_sha256: str, wire_sha256: str | None = None) -> dict[str, Any]:
    """Everything that is stored about a finished run.

    Version 4 if it is an imported log, version 3 if software and devices are recorded, version 2 if it has
    only a wire log.

    :raises LookupError: there is no such run.
    """
    rows = ask(f"SELECT {', '.join(_RUN)}, robot_id FROM calibrations WHERE id = ?", [run])
    if not rows:
        raise LookupError(run)
    *values, robot_id = rows[0]
    robot = ask("SELECT file FROM robots WHERE id = ?", [robot_id])
    result = ask("SELECT result, diagnosis FROM results WHERE calibration_id = ?", [run])
    readings = ask(
        f"SELECT {', '.join(_READING)} FROM readings WHERE calibration_id = ? ORDER BY reading", [run]
    )
    made_by = ask("SELECT what FROM made_by WHERE run_id = ?", [run])
    version: dict[str, Any] = {"version": 1}
    if made_by:
        version = {"version": 3, "wire_sha256": wire_sha256, "made_by": made_by[0][0]}
    elif wire_sha256 is not None:
        version = {"version": 2, "wire_sha256": wire_sha256}
    logs = ask(f"SELECT {', '.join(_LOG)}, content FROM logs WHERE run_id = ? ORDER BY part", [run])
    if logs:
        kept = [
            dict(zip((*_LOG, "content_sha256"), (*own, sha256(content)), strict=True))
            for *own, content in logs
        ]
        version = {"version": 4, "logs": kept}
    return {
        **version,
        **dict(zip(_RUN, values, strict=True)),
        "robot_sha256": sha256(robot[0][0].encode()) if robot else None,
        "readings": [dict(zip(_READING, reading, strict=True)) for reading in readings],
        "samples_sha256": samples_sha256,
        "result": result[0][0] if result else None,
        "diagnosis_sha256": sha256(result[0][1]) if result and result[0][1] is not None else None,
    }


def samples_hash(ask: Ask, run: int) -> str:
    """Hash of the single samples of all readings of a run, in order."""
    rows = ask("SELECT samples FROM readings WHERE calibration_id = ? ORDER BY reading", [run])
    return sha256(rfc8785.dumps([row[0] for row in rows]))


def wire_hash(ask: Ask, run: int) -> str | None:
    """Hash of all pieces of the wire log of a run, in order; None without one."""
    pieces = ask("SELECT piece FROM wire_logs WHERE run_id = ? ORDER BY n", [run])
    return sha256(b"".join(piece[0] for piece in pieces)) if pieces else None


def _broken(ask: Ask, run: int, samples: str, wire: str | None, previous: str, expected: str) -> str | None:
    try:
        record = record_of(ask, run, samples, wire)
    except LookupError:
        return "it is gone"
    if link_hash(previous, record) != expected:
        return "it is not as it ended"
    dropped = ask("SELECT 1 FROM events WHERE calibration_id = ? AND kind = 'samples_dropped'", [run])
    if not dropped and samples_hash(ask, run) != samples:
        return "its samples are not as they were taken"
    dropped = ask("SELECT 1 FROM events WHERE calibration_id = ? AND kind = 'wire_dropped'", [run])
    if not dropped and wire_hash(ask, run) != wire:
        return "its wire log is not as it was recorded"
    return None


def link_hash(previous: str, record: Mapping[str, Any]) -> str:
    """Hash of a record after the previous one."""
    return sha256(previous.encode() + rfc8785.dumps(dict(record)))


def sha256(data: bytes) -> str:
    """SHA-256 in hexadecimal."""
    return hashlib.sha256(data).hexdigest()
