"""Templates of reasons, phrases and reports filled with their values, formatted for a language."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from string import Formatter
from typing import Any

from station.messages.locales import number_in_words
from station.messages.texts import (
    Language,
    dependence_name,
    display_name,
    labels_in_words,
    parameter_name,
    reason_template,
    report_template,
    templates,
)

Values = Mapping[str, float | int | str]


def reason_text(code: str, params: Values, language: Language = "en") -> str:
    """A reason as a sentence. :raises KeyError: the code is unknown, or a parameter is missing."""
    template = reason_template(code, language)
    text = _filled(template, params, language)
    # a text at the start is a sentence as it was written, for instance with the name of a file
    return capital(text) if template.startswith("{causes}") else text


def phrase_text(code: str, params: Values, language: Language = "en") -> str:
    """A phrase by its code. :raises KeyError: the code is unknown, or a parameter is missing."""
    return _filled(templates(language, "phrases")[code], params, language)


def report_text(key: str, language: Language, **values: float | int | str) -> str:
    """A label or sentence of the report on a diagnosis.  :raises KeyError:"""
    return _filled(report_template(key, language), values, language)


def capital(text: str) -> str:
    """The text as it starts a sentence."""
    return text[:1].upper() + text[1:]


def _filled(template: str, params: Values, language: Language) -> str:
    return _Local(language).vformat(template, (), params)


class _Local(Formatter):
    """Numbers and identifiers in the form of the language."""

    def __init__(self, language: Language) -> None:
        self._language: Language = language

    def get_value(self, key: int | str, args: Any, kwargs: Any) -> Any:
        value = kwargs[key]
        named = _IDENTIFIERS.get(str(key))
        return named(value, self._language) if named and isinstance(value, str) else value

    def format_field(self, value: Any, format_spec: str) -> str:
        text: str = super().format_field(value, format_spec)
        return number_in_words(text, self._language) if isinstance(value, float) else text


def _parameters(ids: str, language: Language) -> str:
    """Parameters by their symbols, as in the tables; by their names where the language has no such tables."""
    if language == "en":
        return ids
    return report_template("between", language).join(parameter_name(id, language) for id in ids.split(", "))


_IDENTIFIERS: dict[str, Callable[[str, Language], str]] = {
    "alternative": dependence_name,
    "causes": labels_in_words,
    "depends_on": dependence_name,
    "looks_like": _parameters,
    "parameter": _parameters,
    "plan": lambda id, language: display_name("plans", id, language),
    "unnamed": labels_in_words,
}
"""Values that are identifiers, by their name in the templates."""
