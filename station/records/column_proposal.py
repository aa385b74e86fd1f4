"""A column map proposed from names and numbers of a foreign file, for a person to check."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from station.records.foreign_table import ForeignTable

JOINT = re.compile(r"(joint|theta|axis|^q|^j|^a)_?\d|joint$|_joint|^q\d|^j\d", re.IGNORECASE)
AXIS = r"(^|[_ ]){axis}($|[_ ])"
NOT_MEASURED = re.compile(r"goal|target|command|nominal|std|dev|dif|err|sigma", re.IGNORECASE)
TARGET = re.compile(r"_t($|_)|goal|target|nominal|command", re.IGNORECASE)
DEVIATION = re.compile(r"dif|dev|err|delta", re.IGNORECASE)
OTHERS = (("t_s", "^(t|time|t_s|seconds)$"), ("temperature_c", "temp"), ("payload_kg", "payload"))
TURN = 2.0 * math.pi
LONGEST_M = 15.0
"""A position of which no coordinate is larger is in metres: in millimetres machines stand further off."""


def proposed_map(table: ForeignTable) -> str:
    """MAP.toml as text; comments say what was not found."""
    lines = []
    if table.decimal == ",":
        lines.append('decimal = ","')
    lines.append("[columns]")
    joints = [name for name in table.header if JOINT.search(name) and _numeric(table, name)]
    if joints:
        radians = max(_largest(table, name) for name in joints) < TURN
        lines.append(_line("theta_deg", f"columns = {_quoted(joints)}", "rad" if radians else "deg"))
    else:
        lines.append("# no joint angles were recognised: theta_deg = {columns = [...], unit = ...}")
    lines.append(_position(table, joints))
    for name, pattern in OTHERS:
        found = [own for own in table.header if re.search(pattern, own, re.IGNORECASE)]
        if len(found) == 1 and _numeric(table, found[0]):
            lines.append(f'{name} = "{found[0]}"')
    return "\n".join(lines) + "\n"


def _position(table: ForeignTable, joints: Sequence[str]) -> str:
    others = [name for name in table.header if name not in joints and _numeric(table, name)]
    measured = _axes([name for name in others if not NOT_MEASURED.search(name) and not TARGET.search(name)])
    if measured:
        return _line("tracker_mm", f"columns = {_quoted(measured)}", _length(table, measured))
    target = _axes([name for name in others if TARGET.search(name)])
    deviation = _axes([name for name in others if DEVIATION.search(name)])
    if target and deviation:
        both = f"difference = [{_quoted(target)}, {_quoted(deviation)}]"
        return _line("tracker_mm", both, _length(table, target))
    return "# no measured position was recognised: tracker_mm = {columns = [...], unit = ...}, or range_mm"


def _axes(names: Sequence[str]) -> list[str]:
    """x, y, z among names, empty where they are not clear."""
    out = []
    for axis in "xyz":
        found = [name for name in names if re.search(AXIS.format(axis=axis), name, re.IGNORECASE)]
        if len(found) != 1:
            return []
        out += found
    return out


def _length(table: ForeignTable, names: Sequence[str]) -> str:
    return "m" if max(_largest(table, name) for name in names) < LONGEST_M else "mm"


def _line(name: str, what: str, unit: str) -> str:
    return f'{name} = {{{what}, unit = "{unit}"}}'


def _quoted(names: Sequence[str]) -> str:
    return "[" + ", ".join(f'"{name}"' for name in names) + "]"


def _largest(table: ForeignTable, name: str) -> float:
    return max(abs(float(cell)) for cell in table.column(name))


def _numeric(table: ForeignTable, name: str) -> bool:
    if table.header.count(name) != 1:
        return False
    try:
        return all(math.isfinite(float(cell)) for cell in table.column(name))
    except ValueError:
        return False
