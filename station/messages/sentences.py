"""Translations of a diagnosis's English texts: whole sentences, by their English form.

The page has the same sentences from the same files. `{}` stands for a number, `{name}` for words and
`{name_text}` for whole sentences; a value may be a text to translate itself.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache

from station.messages.texts import (
    DECIMAL_COMMA,
    Language,
    certificate_text,
    effect_name,
    parameter_name,
    report_template,
    templates,
)

_BETWEEN = re.compile(r"(?<=[.?!]) (?=[A-Z])")
_PLACE = re.compile(r"\{(\w*)\}")
_NUMBER = r"([+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?)"
_WORDS = r"((?:(?![.?!] [A-Z]).)+?)"
_SENTENCES = r"(.+?)"
_AND, _COMMA = " and ", ", "


@dataclass(frozen=True)
class _Sentence:
    form: re.Pattern[str]
    places: tuple[str, ...]
    text: str


def in_words(text: str, language: Language) -> str:
    """A text with its sentences translated; an unknown sentence remains in English.

    Several sentences that are known as one are translated together.
    """
    if language == "en":
        return text
    sentences = _BETWEEN.split(text)
    pieces = []
    at = 0
    while at < len(sentences):
        for end in range(len(sentences), at, -1):
            piece = _whole(" ".join(sentences[at:end]), language)
            if piece is not None:
                break
        else:
            piece, end = sentences[at], at + 1
        pieces.append(piece)
        at = end
    return report_template("between_sentences", language).join(pieces)


def labels_in_words(labels: str, language: Language) -> str:
    """Effects by their labels, named or unnamed, with "and" between them."""
    if language == "en":
        return labels
    joint = certificate_text("and", language)
    return joint.join(effect_name(in_words(label, language), language) for label in labels.split(_AND))


def number_in_words(text: str, language: Language) -> str:
    """A formatted number, with the decimal sign of the language."""
    return text.replace(".", ",") if language in DECIMAL_COMMA else text


def _whole(text: str, language: Language) -> str | None:
    for known in _known(language):
        found = known.form.fullmatch(text)
        if found is None:
            continue
        values = [
            _value(value, language) if name else number_in_words(value, language)
            for name, value in zip(known.places, found.groups(), strict=True)
        ]
        named = {name: value for name, value in zip(known.places, values, strict=True) if name}
        numbers = iter([value for name, value in zip(known.places, values, strict=True) if not name])
        return _PLACE.sub(lambda place: named[place[1]] if place[1] else next(numbers), known.text)  # noqa: B023
    return None


def _value(text: str, language: Language) -> str:
    """A text to translate, or identifiers of parameters."""
    said = in_words(text, language)
    if said != text:
        return said
    return _COMMA.join(parameter_name(id, language) for id in text.split(_COMMA))


@cache
def _known(language: Language) -> tuple[_Sentence, ...]:
    """Templates with the most fixed words first."""
    content = templates(language, "sentences")
    by_letters = sorted(content, key=lambda english: -len(_PLACE.sub("", english)))
    return tuple(_Sentence(_form(one), tuple(_PLACE.findall(one)), content[one]) for one in by_letters)


def _form(english: str) -> re.Pattern[str]:
    out, at = "", 0
    for place in _PLACE.finditer(english):
        name = place[1]
        kind = _NUMBER if not name else _SENTENCES if name.endswith("_text") else _WORDS
        out += re.escape(english[at : place.start()]) + kind
        at = place.end()
    return re.compile(out + re.escape(english[at:]))
