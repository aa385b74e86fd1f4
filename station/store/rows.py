"""Between the rows of the database and the records and dictionaries of the program."""

from __future__ import annotations

import json
import math
import sqlite3
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from station.errors import InputRefused
from station.records import CalibrationResult, Reading, ZeroWrite

READING_COLUMNS = (
    "reading, walk, t_s, theta1_deg, theta2_deg, approach1, approach2, scale_mm, position,"
    " samples, temperature_c, payload_kg, mount"
)
LIST_COLUMNS = (
    "id, robot_serial, plan, operator, work_order, of_id, state, verdict, reason, step, steps,"
    " created_ms, started_ms, ended_ms, zero1_deg, zero1_sd_deg, zero2_deg, zero2_sd_deg"
)
# What results have in common need not be stored with each.  Never change it: old results need it.
_WORDS = (
    b'measure the mechanism\'s mounting error, or use the plan `full`","separating_experiment":"alias_set":'
    b'both arms together with a sideways error of the mechanism","share":"p_value":"effect":"joint":"source":'
    b'"findings":[{"effect":"predicted_position_error_mm":{"rms":,"max":}}"before":{"reading_rms_mm":,"after":'
    b'{"reading_rms_mm":"method":"published","parameters":[{"name":"rMx","value":,"sd":,"unit":"mm"},{"name":'
    b'"rMy","unit":"deg"}],"weak_direction":{"singular_ratio":0.00,"text":","sd_deg":,"remedy":"remedies":'
    b'"iterations":[{"pass":1,"dtheta1_deg":,"dtheta2_deg":-,"total1_deg":,"total2_deg":-,"mu_deg":null,'
    b'"condition":47"residuals":[{"reading":1,"position":"P1","residual_mm":0.000,"limit_mm":0.00},{"reading":'
)
_SAMPLE_DIGITS = 5
_SAMPLE_UNIT_MM = 10.0**-_SAMPLE_DIGITS
"""A tenth of the finest step of any supported readout."""
_REST = (
    "before",
    "after",
    "findings",
    "method",
    "parameters",
    "weak_direction",
    "iterations",
    "residuals",
    "memory",
    "lack_of_fit",
)


@dataclass(frozen=True, slots=True)
class Page:
    """Summaries, newest first, and the cursor of the next page (None: this was the last)."""

    items: list[dict[str, Any]]
    next: int | None


def compact(value: Any) -> str:
    """JSON without blanks; NaN is refused, it is not JSON."""
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def utc(ms: int | None) -> str | None:
    """ISO 8601 with milliseconds and Z."""
    if ms is None:
        return None
    return datetime.fromtimestamp(ms / 1000, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def millis(time: datetime) -> int:
    """Since 1970; a time without a zone is UTC."""
    return round((time if time.tzinfo else time.replace(tzinfo=UTC)).timestamp() * 1000)


def row_id(cursor: int | str) -> int:
    """The number in a page's cursor.  :raises InputRefused: it is none."""
    try:
        number = int(cursor)
    except ValueError:
        number = 0
    if not 0 < number < 2**63:
        raise InputRefused(f"The cursor {cursor!r} is not one that a page gave.")
    return number


def unsound(value: Any, where: str = "") -> str | None:
    """Where in a result the first number stands that is not finite; None when all are."""
    if isinstance(value, CalibrationResult):
        value = value.to_json()
    if isinstance(value, float) and not math.isfinite(value):
        return where
    parts: list[tuple[str, Any]] = []
    if isinstance(value, Mapping):
        parts = [(f"{where}.{key}" if where else str(key), part) for key, part in value.items()]
    elif isinstance(value, Sequence) and not isinstance(value, str):
        parts = [(f"{where}[{i}]", part) for i, part in enumerate(value)]
    return next((bad for name, part in parts if (bad := unsound(part, name)) is not None), None)


def pack_result(
    result: CalibrationResult,
) -> tuple[float | None, float | None, float | None, float | None, bytes]:
    """Zero offsets as columns, the rest as one compressed JSON text."""
    zeros = {offset.name: offset for offset in result.zero_offsets}
    first, second = zeros.get("dtheta1"), zeros.get("dtheta2")
    rest = {key: value for key, value in _storable(result.to_json()).items() if key in _REST and value}
    return (
        *((_finite(first.value), _finite(first.sd)) if first else (None, None)),
        *((_finite(second.value), _finite(second.sd)) if second else (None, None)),
        _press(compact(rest)),
    )


def pack_document(document: dict[str, Any] | None) -> bytes | None:
    """With every digit: joint commands are computed from it."""
    return None if document is None else _press(compact(document))


def document_from(blob: bytes) -> dict[str, Any]:
    """The document again."""
    document: dict[str, Any] = json.loads(_expand(blob))
    return document


def _press(text: str) -> bytes:
    pressing = zlib.compressobj(level=9, zdict=_WORDS)
    return pressing.compress(text.encode()) + pressing.flush()


def _expand(blob: bytes) -> str:
    return zlib.decompressobj(zdict=_WORDS).decompress(blob).decode()


def _storable(value: Any) -> Any:
    """Six significant digits are more than any uncertainty asks for, and a third of the bytes."""
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(key): _storable(part) for key, part in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_storable(part) for part in value]
    return value


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def calibration_dict(row: sqlite3.Row, *, full: bool) -> dict[str, Any]:
    """As `GET /api/v1/calibrations` lists it; `full` as the single one is answered."""
    zeros = [
        {"joint": joint, "value_deg": row[f"zero{joint}_deg"], "sd_deg": row[f"zero{joint}_sd_deg"]}
        for joint in (1, 2)
        if row[f"zero{joint}_deg"] is not None
    ]
    columns = ("id", "robot_serial", "plan", "operator", "work_order", "state", "verdict", "reason")
    item: dict[str, Any] = {key: row[key] for key in columns}
    item |= {"of": row["of_id"], "step": row["step"], "steps": row["steps"]}
    item |= {f"{moment}_at": utc(row[f"{moment}_ms"]) for moment in ("created", "started", "ended")}
    item["zero_offsets"] = zeros
    if full:
        item["metadata"] = json.loads(row["metadata"]) if row["metadata"] else {}
        rest = json.loads(_expand(row["rest"])) if row["rest"] else {}
        empty = dict.fromkeys(("before", "after", "method", "weak_direction", "memory", "lack_of_fit"))
        item |= {key: rest.get(key, empty.get(key, [])) for key in _REST}
    return item


def reading_row(reading: Reading) -> tuple[Any, ...]:
    """In the order of READING_COLUMNS.  :raises ValueError: a number that is not finite."""
    numbers = (reading.t_s, *reading.theta_deg, reading.scale_mm, *reading.samples_mm)
    if not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"reading {reading.reading} has a number that is not finite")
    # Samples differ in their last digits: whole units from the mean take a third of the bytes.
    mean = round(reading.scale_mm, _SAMPLE_DIGITS)
    samples = [round((sample - mean) / _SAMPLE_UNIT_MM) for sample in reading.samples_mm]
    return (
        reading.reading,
        reading.walk,
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
    """The record again."""
    return Reading(
        reading=row["reading"],
        t_s=row["t_s"],
        theta_deg=(row["theta1_deg"], row["theta2_deg"]),
        approach=(row["approach1"], row["approach2"]),
        scale_mm=row["scale_mm"],
        position=row["position"],
        walk=row["walk"],
        samples_mm=_samples(row["scale_mm"], row["samples"]),
        temperature_c=row["temperature_c"],
        payload_kg=row["payload_kg"],
        mount=row["mount"],
    )


def zero_write_from_row(row: sqlite3.Row) -> ZeroWrite:
    """The record again."""
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
    mean = round(scale_mm, _SAMPLE_DIGITS)
    return tuple(round(mean + unit * _SAMPLE_UNIT_MM, _SAMPLE_DIGITS) for unit in json.loads(units))
