"""Import of an arm's log as a finished run: the file is stored unchanged and its residual diagnosed."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace

from pydantic import JsonValue

from station.diagnosis import Findings, diagnose, findings_of, page, residuals, without_a_quarter
from station.errors import InputRefused, NotFound
from station.machines import read_log, robot_of
from station.records import (
    FIVE_BAR,
    STATION,
    Actor,
    CalibrationRequest,
    CalibrationResult,
    ColumnMap,
    DataSource,
    ImportedLog,
    KeptLog,
    LogDocuments,
    LogPart,
    Measured,
    Measurements,
    Residual,
    Submitted,
    translated,
)
from station.run_kinds.diagnose import METHOD, stage_accuracy
from station.run_kinds.import_file import MOST_READINGS, Upload, import_dataset
from station.serial_arm import Arm
from station.store import Store, request_hash


@dataclass(frozen=True, slots=True)
class ArmLog:
    """The input: the arm, the log, and the readings for confirmation."""

    arm: Arm
    file: KeptLog
    fresh: KeptLog | None = None
    hold_out: bool = False
    """Whether a quarter of the file confirms the model learned from the other readings."""


@dataclass(frozen=True, slots=True)
class Sent:
    """A file of either kind of machine as it was sent, and how to read it."""

    file: Upload
    fresh: Upload | None = None
    mapping: ColumnMap | None = None
    """Column map of a file from other software."""
    measured: Measured = "position"
    hold_out: bool = False

    def kept(self, part: LogPart, upload: Upload) -> KeptLog:
        """One of the files, as the history keeps it."""
        return KeptLog(part, upload.name, upload.content, self._columns, self.measured)

    def translated(self, upload: Upload) -> Upload:
        """One of the files with the columns of a five-bar's measurement file."""
        if self.mapping is None:
            return upload
        return Upload(upload.name, translated(upload.content, self.mapping, FIVE_BAR, upload.name).content)

    @property
    def _columns(self) -> str:
        return "" if self.mapping is None else self.mapping.model_dump_json(exclude_defaults=True)


def import_log(
    store: Store,
    request: CalibrationRequest,
    log: ArmLog,
    *,
    idempotency_key: str | None = None,
    by: Actor = STATION,
) -> Submitted:
    """Diagnose a log and store it; nothing is stored before the diagnosis is complete.

    :raises InputRefused: the file is malformed, or there are too few readings.
    :raises NotApplicable: the serial is that of another kind of machine.
    :raises KeyReused: the key was used for another request or other files.
    """
    files = [part for part in (log.file, log.fresh) if part is not None]
    request = replace(request, metadata={part.part: _described(part, log) for part in files})
    body_hash = request_hash(request)
    if idempotency_key is not None:
        known = store.find_key(idempotency_key, body_hash)
        if known is not None:
            return Submitted(known, created=False)
    readings, fresh = _readings(log)
    count = len(readings) + (0 if fresh is None else len(fresh))
    found = findings_of(diagnose(log.arm, readings, fresh))
    described = DataSource(
        file=log.file.name, readings=count, sha256=log.file.sha256, guessed=readings.guessed
    )
    documents = _documents(found, log.file.name)
    result = _result(found, described)
    kept = ImportedLog(tuple(files), documents, count)
    created = store.add_run(
        request, log.arm, (), result, log=kept, key=idempotency_key, body_hash=body_hash, by=by
    )
    return Submitted(created, created=True)


def import_measured(
    store: Store,
    request: CalibrationRequest,
    sent: Sent,
    *,
    idempotency_key: str | None = None,
    by: Actor = STATION,
) -> Submitted:
    """Import a file of the robot that is stored under its serial, five-bar or arm.

    :raises InputRefused: the file is malformed, or there are too many or too few readings.
    :raises KeyReused: the key was used for another request or other files.
    """
    arm = _kept_arm(store, request.robot_serial)
    if arm is None:
        if sent.hold_out:
            raise InputRefused("`hold_out` is for logs of arms; a five-bar needs fresh readings.")
        learned = sent.translated(sent.file)
        fresh = None if sent.fresh is None else sent.translated(sent.fresh)
        return import_dataset(store, request, learned, fresh, idempotency_key=idempotency_key, by=by)
    file = sent.kept("file", sent.file)
    judging = None if sent.fresh is None else sent.kept("fresh", sent.fresh)
    rows = sum(log.content.count(b"\n") for log in (file, judging) if log is not None)
    if rows > 2 * MOST_READINGS:
        raise InputRefused(
            f"{sent.file.name}: {rows} rows; over the network at most {2 * MOST_READINGS} of an arm are "
            "diagnosed at once. Import larger logs with `station import`."
        )
    log = ArmLog(arm, file, judging, sent.hold_out)
    return import_log(store, request, log, idempotency_key=idempotency_key, by=by)


def _described(part: KeptLog, log: ArmLog) -> dict[str, JsonValue]:
    """What a repeated request must have in common, beside the robot and the person."""
    out: dict[str, JsonValue] = {"name": part.name, "sha256": part.sha256}
    if part.columns:
        out["columns"] = part.columns
    if part.measured != "position":
        out["measured"] = part.measured
    if log.hold_out:
        out["hold_out"] = True
    return out


def _kept_arm(store: Store, serial: str) -> Arm | None:
    try:
        robot = robot_of(store.robot_file(serial), source=f"robot {serial}")
    except NotFound:
        return None
    return robot if isinstance(robot, Arm) else None


def _readings(log: ArmLog) -> tuple[Measurements, Measurements | None]:
    """:raises InputRefused: both ways to confirm are given, or as for reading a log."""
    readings = _read(log.arm, log.file)
    if log.hold_out:
        if log.fresh is not None:
            raise InputRefused(
                "Fresh readings and a held-out quarter exclude each other: judge by one of them."
            )
        return without_a_quarter(readings)
    return readings, None if log.fresh is None else _read(log.arm, log.fresh)


def _read(arm: Arm, log: KeptLog) -> Measurements:
    mapping = ColumnMap.model_validate_json(log.columns) if log.columns else None
    return read_log(arm, log.content, log.name, log.measured, mapping=mapping)


def _result(found: Findings, data: DataSource) -> CalibrationResult:
    document, view = found.document(data), found.residual
    joints = found.measurements.joints
    # a sliding joint has its zero in mm, listed among the other parameters
    zeros = tuple(q for q in found.parameters[:joints] if q.unit == "deg")
    return CalibrationResult(
        verdict="pass" if found.decision.outcome == "good" else "fail",
        outcome=found.decision.outcome,
        reason=found.reason,
        method=METHOD,
        zero_offsets=zeros,
        parameters=tuple(q for q in found.parameters if q not in zeros),
        weak_direction=found.weak_direction,
        before=stage_accuracy(document.before),
        after=stage_accuracy(document.after),
        residuals=tuple(
            Residual(reading=number, position=label, residual_mm=float(left), limit_mm=float(limit))
            for (number, label), left, limit in zip(
                _numbered(found.measurements.ids), view.after_mm, view.limit_mm, strict=True
            )
        ),
        findings=document.findings,
        diagnosis=document,
    )


def _documents(found: Findings, name: str) -> LogDocuments:
    """The readings by number; other labels in the log are stored as their position."""
    numbers = _numbered(found.measurements.ids)
    rows = residuals(
        found, {own: label for own, (_, label) in zip(found.measurements.ids, numbers, strict=True)}
    )
    items = [asdict(replace(row, reading=n)) for row, (n, _) in zip(rows.rows, numbers, strict=True)]
    content = {"effects": list(rows.effects), "items": items}
    return LogDocuments(json.dumps(content, allow_nan=False), page(found, name).to_html())


def _numbered(ids: Sequence[int | str]) -> list[tuple[int, str]]:
    """A number for each reading (its own, if all are numbered), and its label in the log."""
    own = [one for one in ids if isinstance(one, int)]
    numbers = own if len(own) == len(ids) else range(1, len(ids) + 1)
    return [(number, f"reading {name}") for number, name in zip(numbers, ids, strict=True)]
