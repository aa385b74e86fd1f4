"""Files written by people: station file and robot file from their models, the measurement file's columns."""

from __future__ import annotations

import types
from collections.abc import Iterator
from enum import Enum
from typing import Any, Literal, Union, get_args, get_origin

from annotated_types import Ge, Gt, Le, Lt, MinLen
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from drivers.driver import DriverSettings
from drivers.scales import SCALES
from drivers.servos import SERVOS
from station.five_bar import RobotFile
from station.records import FIVE_BAR, Columns, field_docstrings
from station.reference.markdown import code, page, section, table
from station.serial_arm import ArmFile
from station.settings import Settings

MEANING = {
    "reading": ("", "unique id"),
    "t_s": ("s", "time since the start"),
    "theta": ("deg", "joint angle from the feedback of the drive, in the nominal frame"),
    "approach": ("-1, 0, 1", "sign of the last motion of the joint before the reading; 0: unknown"),
    "scale_mm": ("mm", "reading of the scale, with any constant offset"),
    "range_mm": ("mm", "distance from the fixed point of the instrument to the target"),
    "position": (
        "",
        "id of the position; rows with the same id are repeats or other approaches of the same position",
    ),
    "temperature_c": ("°C", "temperature of the machine"),
    "payload_kg": ("kg", "mass at the end of the machine"),
    "mount": ("", "id of the mounting point of the mechanism; each has its own offset"),
    "setup": ("", "id of the set-up of base and instrument; each has its own base frame"),
    "tracker": ("mm", "independent measurement of the position"),
}
"""Unit and meaning of each column, without the number of a joint or the letter of an axis."""


def station_file_page() -> str:
    """Every section and option, and those of every driver."""
    drivers = [
        *(_driver("scale", "protocol", name, driver.settings) for name, driver in SCALES.items()),
        *(_driver("servo", "profile", name, driver.settings) for name, driver in SERVOS.items()),
    ]
    return page(
        "Station file",
        "TOML. Every option has a default unless it is *required*; an unknown option is refused. "
        "Without a file, and without `[scale]` and `[servo]`, the station runs on the emulated rig. "
        "A relative path starts at the folder of the station file. "
        "An example is [station.toml](../examples/station.toml).",
        *_sections(Settings, ""),
        *drivers,
    )


def robot_file_page() -> str:
    """Sections of the five-bar's file and of the arm's."""
    return page(
        "Robot file",
        "TOML. `[robot] model` determines which sections exist. Without a file, the robot is the five-bar of Table 1 of the paper. "
        "Lengths in mm, angles in degrees; tolerances are standard deviations.",
        section("Five-bar"),
        *_sections(RobotFile, "", level=3),
        section(
            "Serial arm", "", 'With `model = "serial-dh"`. An example is [ur10.toml](../examples/ur10.toml).'
        ),
        *_sections(ArmFile, "", level=3),
    )


def measurement_file_page() -> str:
    """Columns of the five-bar's file and of the arm's."""
    arm = Columns(
        distance="range_mm",
        tracker=("tracker_x_mm", "tracker_y_mm", "tracker_z_mm"),
        more=("setup",),
        either=True,
        time_ordered=False,
    )
    return page(
        "Measurement file",
        "CSV, UTF-8, with a header row, commas and decimal points. Unknown columns are ignored with a warning. "
        "A malformed file is refused; the message states the row, the column and the remedy.",
        section("Five-bar", "", _columns(FIVE_BAR)),
        section(
            "Serial arm",
            "",
            "Columns `theta1_deg` to `thetaN_deg` and `approach1` to `approachN` for N joints. The distance or all three "
            "tracker columns are required. If a file has both, the position is used unless you pass `--measured range`.",
            _columns(arm),
        ),
    )


def _columns(columns: Columns) -> str:
    def row(name: str, required: str) -> tuple[str, str, str, str]:
        key = next(
            k
            for k in (name, name.rstrip("0123456789"), name.split("_")[0].rstrip("0123456789"))
            if k in MEANING
        )
        return code(name), required, *MEANING[key]

    return table(
        ("column", "", "unit", "meaning"),
        [*(row(c, "required") for c in columns.required), *(row(c, "") for c in columns.optional)],
    )


def _driver(place: str, choice: str, name: str, settings: type[DriverSettings]) -> str:
    return section(
        f'[{place}] with {choice} = "{name}"',
        "",
        f"The options of this driver are in `[{place}]` or in `[{place}.{name}]`.",
        _options(settings),
    )


def _sections(model: type[BaseModel], name: str, level: int = 2) -> Iterator[str]:
    title = f"[{name}]" if name else "Top level"
    options = _options(model)
    if options:
        yield section(title, "", _summary(model) if name else "", options, level=level)
    for key, field in model.model_fields.items():
        inner = _model_of(field.annotation)
        if inner is not None and not issubclass(inner, DriverSettings):
            yield from _sections(inner, f"{name}.{key}".lstrip("."), level)


def _summary(model: type[BaseModel]) -> str:
    text = (model.__doc__ or "").strip().split("\n\n")[0]
    text = " ".join(text.partition(": ")[2].split()) if text.startswith("`[") else ""
    return text[:1].upper() + text[1:]


def _options(model: type[BaseModel]) -> str:
    meaning = field_docstrings(model)
    rows = [
        (code(name), _kind(field), _default(field), meaning.get(name, ""))
        for name, field in model.model_fields.items()
        if _model_of(field.annotation) is None
    ]
    return table(("option", "value", "default", "meaning"), rows)


def _model_of(annotation: Any) -> type[BaseModel] | None:
    """The model of a section, or of one item in a list of sections."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((m for arg in get_args(annotation) if (m := _model_of(arg)) is not None), None)


def _kind(field: FieldInfo) -> str:
    kind = _named(field.annotation)
    bounds = [text for item in field.metadata if (text := _bound(item, kind))]
    return ", ".join([kind, *bounds])


def _named(annotation: Any) -> str:
    if get_origin(annotation) is Literal:
        return " or ".join(code(str(value)) for value in get_args(annotation))
    if isinstance(annotation, type) and issubclass(annotation, Enum):
        return " or ".join(code(str(member.value)) for member in annotation)
    if get_origin(annotation) in (Union, types.UnionType):
        return " or ".join(dict.fromkeys(_named(a) for a in get_args(annotation) if a is not type(None)))
    if get_origin(annotation) in (tuple, list):
        inner = get_args(annotation)
        return "list" if get_origin(annotation) is list or ... in inner else f"list of {len(inner)}"
    if get_origin(annotation) is dict:
        return "table"
    bare = get_args(annotation)[0] if get_args(annotation) else annotation
    return {float: "number", int: "whole number", str: "text", bool: "`true` or `false`"}.get(
        bare, getattr(bare, "__name__", "text").lower()
    )


def _bound(item: Any, kind: str) -> str:
    if isinstance(item, Ge):
        return f"at least {item.ge}"
    if isinstance(item, Gt):
        return f"above {item.gt}"
    if isinstance(item, Le):
        return f"at most {item.le}"
    if isinstance(item, Lt):
        return f"below {item.lt}"
    if not isinstance(item, MinLen):
        return ""
    if kind != "text":
        return f"at least {item.min_length} {'entry' if item.min_length == 1 else 'entries'}"
    return "not empty" if item.min_length == 1 else f"at least {item.min_length} characters"


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "required"
    value = field.get_default(call_default_factory=True)
    if value is None or value == {}:
        return ""
    return code(_plain(value))


def _plain(value: Any) -> str:
    if isinstance(value, tuple | list):
        return f"[{', '.join(_plain(v) for v in value)}]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    return f"{value:g}" if isinstance(value, float) else str(value)
