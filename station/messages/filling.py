"""Templates of reasons, phrases and reports filled with their values, formatted for a language."""

from __future__ import annotations

import re
from string import Formatter
from typing import Any

from station.messages.sentences import in_words, labels_in_words, number_in_words
from station.messages.texts import Language, dependence_name, reason_template, report_template

_SHARE = re.compile(r"(?P<labels>.+) \((?P<percent>\d+) %\)")
"""An explanation among others in a reason: `backlash of joint 1 and drift (12 %)`."""


def reason_text(code: str, params: dict[str, float | int | str], language: Language = "en") -> str:
    """A reason as a sentence. :raises KeyError: the code is unknown, or a parameter is missing."""
    return filled(reason_template(code, language), params, language)


def report_text(key: str, language: Language, **values: float | int | str) -> str:
    """A label or sentence of the report on a diagnosis.  :raises KeyError:"""
    return filled(report_template(key, language), values, language)


def filled(template: str, params: dict[str, float | int | str], language: Language) -> str:
    """The template with its values in the format of the language. :raises KeyError: a value is missing."""
    return _Local(language).vformat(template, (), params)


class _Local(Formatter):
    """Numbers, identifiers and English sentences in the form of the language."""

    def __init__(self, language: Language) -> None:
        self._language: Language = language

    def get_value(self, key: int | str, args: Any, kwargs: Any) -> Any:
        value = kwargs[key]
        if not isinstance(value, str):
            return value
        if key == "depends_on":
            return dependence_name(value, self._language)
        if key in ("causes", "unnamed"):
            return labels_in_words(value, self._language)
        if key == "others":
            between = report_template("between", self._language)
            return between.join(map(self._share, value.split(", ")))
        return in_words(value, self._language)

    def _share(self, text: str) -> str:
        found = _SHARE.fullmatch(text)
        if found is None:
            return in_words(text, self._language)
        labels = labels_in_words(found["labels"], self._language)
        return report_template("share_of", self._language).format(labels=labels, percent=found["percent"])

    def format_field(self, value: Any, format_spec: str) -> str:
        text: str = super().format_field(value, format_spec)
        return number_in_words(text, self._language) if isinstance(value, float) else text
