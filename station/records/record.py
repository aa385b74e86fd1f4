"""The base of all models that travel between packages, into the store and over HTTP."""

from __future__ import annotations

import ast
import inspect
from itertools import pairwise
from textwrap import dedent

from pydantic import BaseModel, ConfigDict, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema


def field_docstrings(model: type[BaseModel]) -> dict[str, str]:
    """The docstring below each field of one of our models and of its bases, by name."""
    found = {}
    for base in reversed(model.__mro__):
        if base is BaseModel or not issubclass(base, BaseModel):
            continue
        [definition] = ast.parse(dedent(inspect.getsource(base))).body
        assert isinstance(definition, ast.ClassDef)
        for field, below in pairwise(definition.body):
            match field, below:
                case ast.AnnAssign(target=ast.Name(name)), ast.Expr(ast.Constant(str(text))):
                    found[name] = inspect.cleandoc(text)
    return found


class Record(BaseModel):
    """Immutable. A field is always present, null if unknown; a docstring below it describes it."""

    model_config = ConfigDict(
        frozen=True,
        defer_build=True,
        json_schema_serialization_defaults_required=True,
        validate_by_name=True,
        validate_by_alias=True,
    )

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        # Docstrings are read only here: otherwise every command would need a fifth of a second for them.
        document = handler(schema)
        fields = handler.resolve_ref_schema(document).get("properties", {})
        for name, text in field_docstrings(cls).items():
            key = cls.model_fields[name].alias or name
            if key in fields:
                fields[key]["description"] = text
        return document
