"""What is stored leaves out nulls: every field that may be null has to be readable without."""

from __future__ import annotations

from typing import Any, get_args

from pydantic import BaseModel

from station.records import ResultParts


def models(annotation: Any, seen: set[type[BaseModel]]) -> set[type[BaseModel]]:
    """Every model within a type; a phrase may contain phrases."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel) and annotation not in seen:
        seen.add(annotation)
        for field in annotation.model_fields.values():
            models(field.annotation, seen)
    for part in get_args(annotation):
        models(part, seen)
    return seen


def test_a_result_is_readable_without_its_nulls() -> None:
    within = models(ResultParts, set())
    assert len(within) > 10
    stuck = {
        f"{model.__name__}.{name}"
        for model in within
        for name, field in model.model_fields.items()
        if type(None) in get_args(field.annotation) and field.is_required()
    }
    assert stuck == set()
