"""What is stored leaves out nulls: every field that may be null has to be readable without."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, get_args

from pydantic import BaseModel

from station.records import ResultParts


def models(annotation: Any) -> Iterator[type[BaseModel]]:
    """Every model within a type, once for each place where it stands."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
        for field in annotation.model_fields.values():
            yield from models(field.annotation)
    for part in get_args(annotation):
        yield from models(part)


def test_a_result_is_readable_without_its_nulls() -> None:
    within = set(models(ResultParts))
    assert len(within) > 10
    stuck = {
        f"{model.__name__}.{name}"
        for model in within
        for name, field in model.model_fields.items()
        if type(None) in get_args(field.annotation) and field.is_required()
    }
    assert stuck == set()
