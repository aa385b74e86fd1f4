"""Numbers that are not booleans: Python accepts `true` as a number, but `mm = true` is not 1 mm."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, GetCoreSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError
from pydantic_core.core_schema import no_info_before_validator_function

_NUMBERS = ("float", "int")


def _number(value: object) -> object:
    if isinstance(value, bool):
        raise PydanticCustomError("number", "must be a number, not true or false")
    return value


def _refuse_truth_values(node: object) -> None:
    """Add the check to every number of a schema, in place."""
    if isinstance(node, list | tuple):
        for part in node:
            _refuse_truth_values(part)
    elif isinstance(node, dict):
        if node.get("function", {}) == {"type": "no-info", "function": _number}:
            return  # a nested model that is already processed
        numbers = all(type(choice) is int for choice in node.get("expected", ()))
        if node.get("type") in _NUMBERS or (node.get("type") == "literal" and numbers):
            checked = no_info_before_validator_function(_number, node.copy())
            node.clear()
            node.update(checked)
            return
        for key, part in node.items():
            if key != "default":
                _refuse_truth_values(part)


class StrictNumbers(BaseModel):
    """Base of input from people and programs; each number in it, at any depth, refuses true and false."""

    model_config = ConfigDict(defer_build=True)  # most commands use few of the models

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        _refuse_truth_values(schema)
        return schema
