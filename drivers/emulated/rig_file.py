"""The rig file: TOML in, TOML out.  The station never reads it."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from drivers.emulated.spec import RigSpec

RIGS = Path(__file__).parent / "rigs"
DEFAULT_RIG = RIGS / "paper_group1.toml"


class RigFileError(ValueError):
    """A rig file is unusable; the text is one sentence."""


def load_rig(path: Path) -> RigSpec:
    """Read and check a rig file.

    :raises RigFileError: naming the file, the entry and the error
    """
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise RigFileError(f"The rig file {path} cannot be read: {error.strerror}.") from error
    except UnicodeDecodeError as error:
        raise RigFileError(f"The rig file {path} is not text in UTF-8.") from error
    return parse_rig(text, str(path))


def parse_rig(text: str, name: str = "rig file") -> RigSpec:
    """The same from text; `name` is its name in errors. :raises RigFileError:"""
    try:
        tables: dict[str, Any] = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise RigFileError(f"{name} is not TOML: {error}.") from error
    unknown = sorted(tables.keys() - {"machine", "emulated", "effect", "fault"})
    if unknown:
        raise RigFileError(
            f"{name} has the unknown table [{unknown[0]}]; machine, emulated, effect and fault exist."
        )
    machine, emulated = tables.get("machine", {}), tables.get("emulated", {})
    if not (isinstance(machine, dict) and isinstance(emulated, dict)):
        raise RigFileError(f"{name}: machine and emulated are tables, [machine] and [emulated].")
    if "effects" in machine:
        raise RigFileError(f"{name}: effects are written as [[effect]] tables of their own.")
    machine = machine | {"effects": tables.get("effect", [])}
    faults = tables.get("fault", [])
    orders = [fault for fault in faults if isinstance(fault, dict) and "device" in fault]
    scripted = [fault for fault in faults if fault not in orders]
    try:
        return RigSpec.model_validate(
            {"machine": machine, "emulated": emulated, "faults": scripted, "orders": orders}
        )
    except ValidationError as error:
        raise RigFileError(_sentence(name, error)) from error


def dump_rig(spec: RigSpec) -> str:
    """A rig file that reads back as `spec` and contains only the differences from the defaults."""
    machine = _given(spec.machine)
    machine.pop("effects", None)
    lines = ["[machine]", *_entries(machine), "", "[emulated]", *_entries(_given(spec.emulated))]
    for effect in spec.machine.effects:
        lines += ["", "[[effect]]", *_entries({"kind": effect.kind, **_given(effect)})]
    for fault in (*spec.faults, *spec.orders):
        lines += ["", "[[fault]]", *_entries(_given(fault))]
    return "\n".join(lines) + "\n"


def _given(table: BaseModel) -> dict[str, Any]:
    return table.model_dump(mode="json", exclude_defaults=True)


def _entries(table: dict[str, Any]) -> list[str]:
    # numbers, booleans, strings and arrays have the same form in JSON and TOML
    return [f"{key} = {json.dumps(value)}" for key, value in table.items()]


def _sentence(name: str, error: ValidationError) -> str:
    first = error.errors()[0]
    place = list(first["loc"])
    if place[:2] == ["machine", "effects"]:
        table, rest = "[[effect]]", place[2:]
    elif place[:1] in (["faults"], ["orders"]):
        table, rest = "[[fault]]", place[1:]
    else:
        table, rest = f"[{place[0]}]", place[1:]
    if table.startswith("[[") and rest:
        table += f" {int(rest.pop(0)) + 1}"
    if rest:
        table += " " + ".".join(str(part) for part in rest)
    return f"{name}: {table}: {first['msg'].lower()}."
