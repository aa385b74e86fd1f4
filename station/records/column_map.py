"""The column map: the assignment of a foreign file's columns to those of the contract, with units."""

from __future__ import annotations

from codecs import BOM_UTF8
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, ValidationError

from station.records.files import content_of
from station.records.sections import Finite, Section, refusal, sections_of_toml
from station.records.units import Unit

ROW_NUMBER = "row number"
Name = str | int
"""Name of a column; a number if the file has no names."""


class FromColumn(Section):
    """One column of the file, or the difference of two columns, or a constant."""

    column: Name | None = None
    difference: tuple[Name, Name] | None = None
    constant: str | float | None = None
    unit: Unit | None = None
    """Unit; by default that of the contract."""
    factor: Finite = 1.0
    """Factor for every number: a sign, or the unit's counts."""


class FromColumns(Section):
    """Several columns of a kind at once: all joints, or x, y, z, the latter also of several points."""

    columns: Annotated[list[Name] | list[list[Name]], Field(min_length=1)] | None = None
    difference: tuple[list[Name], list[Name]] | None = None
    unit: Unit | list[Unit] | None = None
    """One unit for all columns, or one for each."""
    factor: Finite | list[Finite] = 1.0


Source = FromColumn | str | int
Group = FromColumns | list[Name] | list[list[Name]]


class ColumnMap(Section):
    """A file `MAP.toml`."""

    header: bool | None = None
    """Whether a row names the columns; otherwise they are numbered from 1. By default it is detected."""
    separator: str = ""
    decimal: Literal["", ".", ","] = ""
    sheet: str = ""
    """Sheet of a spreadsheet; by default the one with most numbers."""
    missing: list[Finite] | None = None
    """Value in the file for a position that was not measured; such rows are excluded."""
    columns: dict[str, Source | Group] = Field(default_factory=dict)

    @classmethod
    def read(cls, path: Path) -> ColumnMap:
        """:raises InputRefused: the file is missing, not TOML, or contains an invalid key or value."""
        return cls.parse(content_of(path, "Column map"), f"Column map {path}")

    @classmethod
    def parse(cls, content: bytes, source: str = "Column map") -> ColumnMap:
        """:raises InputRefused: the text is not TOML, or contains an invalid key or value."""
        try:
            return cls.model_validate(sections_of_toml(content.removeprefix(BOM_UTF8), source))
        except ValidationError as error:
            raise refusal(error, source) from error
