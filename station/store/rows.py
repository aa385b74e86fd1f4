"""Conversion between the rows of the database and the records of the program."""

from __future__ import annotations

import hashlib
import json
import math
import sqlite3
import zlib
from dataclasses import dataclass
from datetime import UTC, datetime

from pydantic import JsonValue
from pydantic_core import from_json

from station.errors import InputRefused
from station.records import (
    LARGEST_ID,
    Calibration,
    CalibrationRequest,
    CalibrationResult,
    CalibrationSummary,
    DiagnosisDocument,
    Reading,
    Reason,
    ResultParts,
    ZeroWrite,
)

READING_COLUMNS = (
    "reading, walk, t_s, theta1_deg, theta2_deg, approach1, approach2, scale_mm, position,"
    " samples, temperature_c, payload_kg, mount"
)
LIST_COLUMNS = (
    "id, uid, robot_serial, kind, plan, operator, work_order, of_id, state, verdict, outcome, reason,"
    " reason_code, reason_params, step, steps, created_ms, started_ms, ended_ms,"
    " zero1_deg, zero1_sd_deg, zero2_deg, zero2_sd_deg"
)
IN_LISTS = 2
"""Number of zero offsets that lists show; an arm has more."""
_SAMPLE_DIGITS = 5
_SAMPLE_UNIT_MM = 10.0**-_SAMPLE_DIGITS
"""A tenth of the finest step of any supported readout."""
_SAMPLES_PER_MM = 10**_SAMPLE_DIGITS


@dataclass(frozen=True, slots=True)
class Page:
    """Summaries, newest first, and the cursor of the next page (None: this was the last)."""

    items: list[CalibrationSummary]
    next: int | None


def compact(value: object) -> str:
    """JSON without blanks; NaN is refused, it is not JSON."""
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def moment(ms: int | None) -> datetime | None:
    """A time in UTC."""
    return None if ms is None else datetime.fromtimestamp(ms / 1000, UTC)


def millis(time: datetime) -> int:
    """Milliseconds since 1970; a time without a zone is UTC."""
    return round((time if time.tzinfo else time.replace(tzinfo=UTC)).timestamp() * 1000)


def row_id(cursor: int | str) -> int:
    """The number in a page's cursor.  :raises InputRefused: it is not a cursor."""
    try:
        number = int(cursor)
    except ValueError:
        number = 0
    if not 0 < number <= LARGEST_ID:
        raise InputRefused(f"The cursor {cursor!r} is not one that a page gave.")
    return number


def result_row(
    result: CalibrationResult,
) -> tuple[float | None, float | None, float | None, float | None, float | None, str]:
    """Zero offsets and the position error as columns, and the whole as one JSON text that SQL can query."""
    zeros = {offset.name: offset for offset in result.zero_offsets}
    first, second = zeros.get("dtheta1"), zeros.get("dtheta2")
    parts = ResultParts.model_validate(dict(result)).model_dump(mode="json", by_alias=True)
    kept = {key: value for key, value in parts.items() if value not in (None, "", [], {})}
    offsets: list[JsonValue] = [
        {"joint": int(q.name.removeprefix("dtheta")), "value_deg": q.value, "sd_deg": q.sd}
        for q in result.zero_offsets
    ]
    return (
        *((_finite(first.value), _finite(first.sd)) if first else (None, None)),
        *((_finite(second.value), _finite(second.sd)) if second else (None, None)),
        _verified_error_mm(result),
        compact(_storable({"zero_offsets": offsets, **kept})),
    )


def _verified_error_mm(result: CalibrationResult) -> float | None:
    """95 % bound of the largest position error, where fresh readings verified it."""
    after, accuracy = result.after, result.accuracy
    if after is None or after.fresh_reading_rms_mm is None:
        return None
    predicted = after.predicted_position_error_mm
    bounds = [accuracy.bound_95_mm] if accuracy else []
    bounds += [predicted.bound_95, predicted.max] if predicted else []
    bound = next((bound for bound in bounds if bound is not None), None)
    return None if bound is None else _finite(bound)


def pack_document(document: DiagnosisDocument | None) -> bytes | None:
    """The document with every digit, since joint commands are computed from it. Plain zlib."""
    return None if document is None else zlib.compress(document.model_dump_json(by_alias=True).encode(), 9)


def document_from(blob: bytes) -> DiagnosisDocument:
    """The document restored, also one of an older schema."""
    return DiagnosisDocument.model_validate_json(zlib.decompress(blob))


def _storable(value: JsonValue) -> JsonValue:
    """Rounded to six significant digits: more than any uncertainty needs, and a third of the bytes."""
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _storable(part) for key, part in value.items() if part is not None}
    if isinstance(value, list):
        return [_storable(part) for part in value]
    return value


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def summary_from_row(row: sqlite3.Row) -> CalibrationSummary:
    """A run as lists show it."""
    return CalibrationSummary.model_validate(_summary(row))


def calibration_from_row(row: sqlite3.Row) -> Calibration:
    """The complete record in the store; the state of its zeros in the drives is not in its row."""
    parts = json.loads(row["result"]) if row["result"] else {}
    offsets = parts.pop("zero_offsets", [])
    summary = _summary(row) | ({"zero_offsets": offsets} if len(offsets) > IN_LISTS else {})
    metadata = json.loads(row["metadata"]) if row["metadata"] else {}
    return Calibration.model_validate({**parts, **summary, "metadata": metadata})


def _summary(row: sqlite3.Row) -> dict[str, object]:
    same = (
        "id", "uid", "robot_serial", "kind", "plan", "operator", "work_order", "state", "verdict", "outcome",
        "reason", "reason_code", "step", "steps",
    )  # fmt: skip
    return {
        **{key: row[key] for key in same},
        "of": row["of_id"],
        "reason_params": json.loads(row["reason_params"]) if row["reason_params"] else {},
        **{f"{name}_at": moment(row[f"{name}_ms"]) for name in ("created", "started", "ended")},
        "zero_offsets": [
            {"joint": joint, "value_deg": row[f"zero{joint}_deg"], "sd_deg": row[f"zero{joint}_sd_deg"]}
            for joint in (1, 2)
            if row[f"zero{joint}_deg"] is not None
        ],
    }


def request_hash(request: CalibrationRequest) -> bytes:
    """Shows whether an idempotency key came with the same request."""
    fields = {
        "robot_serial": request.robot_serial,
        "plan": request.label,
        "operator": request.operator,
        "work_order": request.work_order,
        "metadata": dict(sorted(request.metadata.items())),
        "of": request.of,
        **asked_more(request),
    }
    return hashlib.sha256(compact(fields).encode()).digest()[:16]


def asked_more(request: CalibrationRequest) -> dict[str, JsonValue]:
    """The accuracy, references and gauge study of a request, if it contains any."""
    more: dict[str, JsonValue] = {
        "references": [reference.model_dump() for reference in request.references],
        "until_mm": request.until_mm,
        "accuracy_mm": request.accuracy_mm,
        "study": request.study.model_dump() if request.study else None,
    }
    return {key: value for key, value in more.items() if value}


def reading_row(reading: Reading) -> tuple[object, ...]:
    """In the order of READING_COLUMNS.  :raises ValueError: a number that is not finite."""
    numbers = (reading.t_s, *reading.theta_deg, reading.scale_mm, *reading.samples_mm)
    if not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"reading {reading.reading} has a number that is not finite")
    # Samples differ in their last digits: integer units from the mean take a third of the bytes.
    mean = round(reading.scale_mm, _SAMPLE_DIGITS)
    samples = [round((sample - mean) / _SAMPLE_UNIT_MM) for sample in reading.samples_mm]
    return (
        reading.reading,
        reading.sequence,
        round(reading.t_s, 3),
        *reading.theta_deg,
        *reading.approach,
        reading.scale_mm,
        reading.position,
        compact(samples) if samples else None,
        reading.temperature_c,
        reading.payload_kg,
        reading.mount,
    )


def reading_from_row(row: sqlite3.Row) -> Reading:
    """The record from a row of READING_COLUMNS."""
    number, sequence, t_s, theta1, theta2, first, second, scale_mm, position, samples, *more = row
    temperature_c, payload_kg, mount = more
    return Reading(
        reading=number,
        t_s=t_s,
        theta_deg=(theta1, theta2),
        approach=(first, second),
        scale_mm=scale_mm,
        position=position,
        sequence=sequence,
        samples_mm=_samples(scale_mm, samples),
        temperature_c=temperature_c,
        payload_kg=payload_kg,
        mount=mount,
    )


def zero_write_from_row(row: sqlite3.Row) -> ZeroWrite:
    """The record from a row."""
    return ZeroWrite(
        id=row["id"],
        run_id=row["run_id"],
        of=row["of_id"],
        joint=row["joint"],
        offset_deg=row["offset_deg"],
        from_deg=row["from_deg"],
        to_deg=row["to_deg"],
        taken=None if row["taken"] is None else bool(row["taken"]),
    )


def _samples(scale_mm: float, units: str | None) -> tuple[float, ...]:
    if units is None:
        return ()
    mean, kept = round(round(scale_mm, _SAMPLE_DIGITS) / _SAMPLE_UNIT_MM), from_json(units)
    if isinstance(kept, int):  # only their number was stored, which gives the uncertainty of their mean
        return (mean / _SAMPLES_PER_MM,) * kept
    # the quotient of integers equals the value rounded to this many digits, in a third of the time
    return tuple((mean + unit) / _SAMPLES_PER_MM for unit in kept)


def reason_columns(reason: Reason | None) -> tuple[str | None, str | None, str | None]:
    """Text, code and parameters of a reason, as they are stored."""
    if reason is None:
        return None, None, None
    params = reason.model_dump(mode="json")["params"]
    return reason.text or None, reason.code, compact(params) if params else None
