"""Files that commands read and write."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, TypeVar, get_args

import click

from station.records import ColumnMap, DataSource, Measured, Record

_Command = TypeVar("_Command", bound=Callable[..., Any])

file_path = click.Path(path_type=Path)
"""Looked at when it is opened: what is wrong with it is said in this program's words."""
new_file = click.Path(dir_okay=False, path_type=Path)
robot_option = click.option(
    "--robot", "robot_file", type=file_path, help="Robot file.  [default: Table 1 of the paper]"
)
measured_option = click.option(
    "--measured",
    type=click.Choice(get_args(Measured)),
    default="position",
    show_default=True,
    help="Which measurement to use if the log of an arm contains both.",
)


def _column_map(_context: click.Context, _option: click.Parameter, path: Path | None) -> ColumnMap | None:
    return None if path is None else ColumnMap.read(path)


columns_option = click.option(
    "--columns",
    "mapping",
    type=file_path,
    callback=_column_map,
    help="Column map of a file from other software; `station columns` proposes one.",
)


def json_option(content: str) -> Callable[[_Command], _Command]:
    """--json, under which a command writes `content`."""
    return click.option("--json", "json_file", type=new_file, help=f"File for {content}, as JSON.")


def describe(path: Path, readings: int, guessed: Iterable[str] = ()) -> DataSource:
    """What a result was made from."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return DataSource(file=path.name, readings=readings, sha256=digest, guessed=tuple(guessed))


def check_folders(*files: Path | None) -> None:
    """Before minutes of work, not after.  :raises click.UsageError: there is no such folder."""
    for file in files:
        if file and not file.parent.is_dir():
            raise click.UsageError(f"{file} cannot be written: there is no folder {file.parent}.")


def write_json(path: Path, content: Record | Mapping[str, object]) -> None:
    """Finite numbers only.  :raises click.UsageError: the file cannot be written."""
    plain = content.model_dump(by_alias=True) if isinstance(content, Record) else content
    write_text(path, json.dumps(plain, indent=1, allow_nan=False) + "\n")


def write_text(path: Path, text: str) -> None:
    """:raises click.UsageError: the file cannot be written."""
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes) -> None:
    """:raises click.UsageError: the file cannot be written."""
    try:
        path.write_bytes(content)
    except OSError as error:
        raise click.UsageError(f"{path} cannot be written: {error.strerror}.") from error
