"""A column map proposed from the names and numbers of a foreign file, to be checked by a person."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from itertools import pairwise

from station.errors import InputRefused
from station.records.column_words import (
    DISTANCE,
    TEMPERATURE,
    TIME,
    is_commanded,
    is_deviation,
    is_measured,
    joint_columns,
    matrix_columns,
    of_one_kind,
    point_columns,
)
from station.records.foreign_numbers import has_value
from station.records.foreign_table import ForeignTable
from station.records.pose_matrix import position_columns
from station.records.translation import seconds
from station.records.units import TO_CONTRACT, unit_in_name

TURN = 2.0 * math.pi
LONGEST_M = 15.0
"""A position without a larger coordinate is in metres: in millimetres machines are further away."""
FURTHEST_M = 150.0
"""So is one within the range of an instrument whose coordinates differ by less than LONGEST_M."""
_MATRICES = (16, 12)


def proposed_map(table: ForeignTable) -> str:
    """MAP.toml as text; comments list the columns that were not found."""
    lines = [] if table.named else ["header = false"]
    if table.decimal == ",":
        lines.append('decimal = ","')
    if twice := sorted({name for name in table.header if table.header.count(name) > 1}):
        lines.append(f"# appear twice: {', '.join(twice)}; with header = false columns go by number, from 1")
    lines.append("[columns]")
    numeric = [name for name in table.header if _numeric(table, name)]
    joints, *others = (joint_columns(numeric) if table.named else [_unnamed_joints(table, numeric)]) or [[]]
    if not joints:
        lines.append("# no joint angles were recognised: theta_deg = {columns = [...], unit = ...}")
    else:
        lines.append(_group(table, "theta_deg", joints, _angle_unit(table, joints)))
        lines += [f"# or joint angles: {_quoted(table, group)}" for group in others]
    left = [name for name in numeric if not any(name in group for group in (joints, *others))]
    lines += _position(table, left)
    for name, pattern in (("range_mm", DISTANCE), ("temperature_c", TEMPERATURE)):
        found = [
            own for own in left if pattern.search(own) and not is_commanded(own) and not is_deviation(own)
        ]
        if len(found) == 1:
            unit = _length_unit(table, found) if name == "range_mm" else ""
            lines.append(_single(table, name, found[0], unit))
    lines += _time(table)
    return "\n".join(lines) + "\n"


def _unnamed_joints(table: ForeignTable, numeric: Sequence[str]) -> list[str]:
    """The joints of a file without names: the columns before three coordinates or a matrix."""
    own = list(numeric)
    if own and _counts(table, own[0]):
        own = own[1:]
    for size in (*_MATRICES, 3):
        if len(own) > size + 1 and (size == 3 or _is_matrix(table, own[-size:])):
            return own[:-size]
    return []


def _position(table: ForeignTable, names: Sequence[str]) -> list[str]:
    if not table.named:
        return _unnamed_position(table, names)
    if (matrix := matrix_columns(names)) and _is_matrix(table, matrix):
        return [_pose(table, matrix)]
    points = point_columns(names)
    measured = {s: p for s, p in points.items() if not is_deviation(s) and not is_commanded(s)}
    if len(measured) > 1 and (sure := {s: p for s, p in measured.items() if is_measured(s)}):
        measured = sure
    if several := of_one_kind(measured):
        nested = ", ".join(_quoted(table, measured[stem]) for stem in several)
        unit = _length_unit(table, [name for stem in several for name in measured[stem]])
        return [f'tracker_mm = {{columns = [{nested}], unit = "{unit}"}}']
    if measured:
        first, *others = measured.values()
        lines = [_group(table, "tracker_mm", first, _length_unit(table, first))]
        return lines + [f"# or position: {_quoted(table, other)}" for other in others]
    target = next((p for s, p in points.items() if is_commanded(s)), None)
    off = next((p for s, p in points.items() if is_deviation(s)), None)
    if target and off:
        both = f"difference = [{_quoted(table, target)}, {_quoted(table, off)}]"
        return [f'tracker_mm = {{{both}, unit = "{_length_unit(table, target)}"}}']
    if any(DISTANCE.search(name) for name in names):
        return []
    return ["# no measured position was recognised: tracker_mm = {columns = [...], unit = ...}, or range_mm"]


def _unnamed_position(table: ForeignTable, names: Sequence[str]) -> list[str]:
    own = [name for name in names if not (name == table.header[0] and _counts(table, name))]
    if len(own) in _MATRICES and _is_matrix(table, own):
        return [_pose(table, own)]
    if len(own) == 3:
        return [_group(table, "tracker_mm", own, _length_unit(table, own))]
    return ["# no measured position was recognised: tracker_mm = {columns = [...], unit = ...}, or range_mm"]


def _is_matrix(table: ForeignTable, names: Sequence[str]) -> bool:
    try:
        position_columns([table.column(name) for name in names], "")
    except InputRefused:
        return False
    return True


def _pose(table: ForeignTable, names: Sequence[str]) -> str:
    at = position_columns([table.column(name) for name in names], "")
    return _group(table, "pose", names, _length_unit(table, [names[i] for i in at]))


def _time(table: ForeignTable) -> list[str]:
    """The first column that can be a time, unless a spreadsheet has damaged it."""
    for name in table.header:
        if TIME.search(name) and table.header.count(name) == 1:
            cells, unit = table.column(name), _unit(table, name, "s")
            try:
                times = [float(cell) for cell in seconds(table, cells, 1.0)]
            except InputRefused:
                continue
            if all(map(math.isfinite, times)) and max(times) > min(times):
                return [_single(table, "t_s", name, unit)]
    return []


def _single(table: ForeignTable, name: str, column: str, unit: str) -> str:
    given = _quoted(table, [column])[1:-1]
    plain = unit in ("", name.rpartition("_")[2])
    return f"{name} = {given}" if plain else f'{name} = {{column = {given}, unit = "{unit}"}}'


def _angle_unit(table: ForeignTable, names: Sequence[str]) -> str:
    by_size = "rad" if max(_largest(table, name) for name in names) < TURN else "deg"
    # a name of the contract implies degrees, whatever the file contains
    own = names[0].startswith("theta") and names[0].endswith("_deg")
    return by_size if own else _unit(table, names[0], "deg") or by_size


def _length_unit(table: ForeignTable, names: Sequence[str]) -> str:
    furthest, spread = max(_largest(table, name) for name in names), max(_spread(table, n) for n in names)
    by_size = "m" if furthest < LONGEST_M or (furthest < FURTHEST_M and spread < LONGEST_M) else "mm"
    own = names[0].startswith(("tracker_", "range_")) and names[0].endswith("_mm")
    return by_size if own else _unit(table, names[0], "mm") or by_size


def _unit(table: ForeignTable, name: str, kind: str) -> str:
    """The unit as stated in the file; empty if there is none."""
    unit = table.unit(name) or unit_in_name(name)
    return unit if unit in TO_CONTRACT[kind] else ""


def _group(table: ForeignTable, name: str, columns: Sequence[str], unit: str) -> str:
    return f'{name} = {{columns = {_quoted(table, columns)}, unit = "{unit}"}}'


def _quoted(table: ForeignTable, names: Sequence[str]) -> str:
    return json.dumps([name if table.named else int(name) for name in names], ensure_ascii=False)


def _counts(table: ForeignTable, name: str) -> bool:
    """Whether a column only numbers the rows."""
    values = _values(table, name)
    return all(b - a == 1.0 for a, b in pairwise(values))


def _largest(table: ForeignTable, name: str) -> float:
    return max((abs(value) for value in _values(table, name)), default=0.0)


def _spread(table: ForeignTable, name: str) -> float:
    values = _values(table, name)
    return max(values) - min(values)


def _values(table: ForeignTable, name: str) -> list[float]:
    return [float(cell) for cell in table.column(name) if has_value(cell)]


def _numeric(table: ForeignTable, name: str) -> bool:
    """Whether a column contains numbers; some may be missing."""
    if table.header.count(name) != 1:
        return False
    try:
        values = _values(table, name)
    except ValueError:
        return False
    return bool(values) and all(map(math.isfinite, values))
