"""Sections of files written by people (station file, robot file): strict, with readable errors."""

from __future__ import annotations

import json
import tomllib
from typing import Annotated, Any

from pydantic import ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from drivers.strict_numbers import StrictNumbers
from station.errors import InputRefused

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Sections = dict[str, Any]
"""The sections of a file as read, not yet checked."""


class Section(StrictNumbers):
    """A misspelt option is refused, never ignored."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def sections_of_toml(content: bytes, source: str) -> Sections:
    """:raises InputRefused: it is not TOML, or contains values that no section may contain."""
    try:
        return tomllib.loads(content.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputRefused(f"{source} is not valid TOML: {error}.") from error


def said(error: ErrorDetails) -> str:
    """The error of one value, in words for a person: no pattern, no name of a check."""
    if error["type"] == "string_pattern_mismatch":
        return "Input holds characters that cannot be here, or lacks some that must"
    return error["msg"].removeprefix("Value error, ")


def refusal(error: ValidationError, source: str) -> InputRefused:
    """The first invalid value, with the file, the section and the key."""
    first = error.errors()[0]
    where = ".".join(str(part) for part in first["loc"])
    return InputRefused(f"{source}: [{where}] {said(first)} (given: {first['input']!r}).")


def sections_to_toml(sections: Sections, path: str = "") -> str:
    """The text of a file with these sections: numbers, strings, truth values and lists of them."""
    lines = [f"[{path}]"] if path else []
    tables = {key: value for key, value in sections.items() if isinstance(value, dict)}
    # numbers, strings and lists have the same form in TOML and JSON
    lines += [f"{key} = {json.dumps(value)}" for key, value in sections.items() if key not in tables]
    text = "".join(f"{line}\n" for line in lines) + ("\n" if path else "")
    return text + "".join(
        sections_to_toml(table, f"{path}.{key}" if path else key) for key, table in tables.items()
    )
