"""Import of a measurement file as a finished run: its readings are stored and its residual diagnosed."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace

from station.diagnosis import Context
from station.errors import InputRefused
from station.five_bar import Robot
from station.records import (
    STATION,
    Actor,
    CalibrationRequest,
    DataSource,
    Reading,
    Submitted,
    parse_readings,
    recorded_columns,
)
from station.run_kinds.diagnose import diagnosed, result_of
from station.run_kinds.kind import RunKind, register
from station.store import Store, request_hash

MOST_READINGS = 2000
"""Limit for both files together. The loop takes a second for these; time grows with their square."""


@dataclass(frozen=True, slots=True)
class Upload:
    """A measurement file as received."""

    name: str
    content: bytes

    @property
    def sha256(self) -> str:
        return hashlib.sha256(self.content).hexdigest()


def import_dataset(
    store: Store,
    request: CalibrationRequest,
    learned: Upload,
    fresh: Upload | None = None,
    *,
    robot: Robot | None = None,
    idempotency_key: str | None = None,
    by: Actor = STATION,
) -> Submitted:
    """Diagnose the readings of a file and store both; `fresh` readings, taken afterwards, confirm the result.

    :param robot: by default the one stored for the serial, otherwise the nominal one

    Nothing is stored before the diagnosis is complete, so a refusal leaves no data.

    :raises InputRefused: the file is malformed, or there are too few readings.
    :raises KeyReused: the key was used for another request or other files.
    """
    files = {"file": learned, "fresh": fresh}
    request = replace(
        request,
        metadata={k: {"name": f.name, "sha256": f.sha256} for k, f in files.items() if f is not None},
    )
    body_hash = request_hash(request)
    if idempotency_key is not None:
        known = store.find_key(idempotency_key, body_hash)
        if known is not None:
            return Submitted(known, created=False)
    robot = robot or store.robot_or_nominal(request.robot_serial)
    readings = parse_readings(learned.content, source=learned.name, in_order=False)
    later: list[Reading] = []
    if fresh is not None:
        later = parse_readings(
            fresh.content, sequence=2, after=readings[-1].reading, source=fresh.name, in_order=False
        )
    if len(readings) + len(later) > MOST_READINGS:
        raise InputRefused(
            f"{learned.name}: {len(readings) + len(later)} readings with the fresh ones; at most "
            f"{MOST_READINGS} are diagnosed at once, so give a part of them."
        )
    found = diagnosed(robot, [*readings, *later], _context(learned))
    result = result_of(found, readings, _described(learned, len(readings)))
    created = store.add_run(
        request,
        robot,
        [*readings, *later],
        result,
        key=idempotency_key,
        body_hash=body_hash,
    )
    return Submitted(created, created=True)


def _context(file: Upload) -> Context:
    """What the file recorded."""
    recorded = recorded_columns(file.content)
    return Context("approach1" in recorded or "approach2" in recorded, "position" in recorded, file.name)


def _described(file: Upload, readings: int) -> DataSource:
    return DataSource(file=file.name, readings=readings, sha256=file.sha256)


IMPORT = register(RunKind("import", None))
