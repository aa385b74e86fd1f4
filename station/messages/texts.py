"""Texts by language, group and identifier."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import Literal, get_args

Language = Literal["en", "de", "zh"]
LANGUAGES: tuple[Language, ...] = get_args(Language)
Group = Literal[
    "effects", "parameters", "plans", "states", "verdicts", "outcomes", "run_kinds", "dependences"
]
DECIMAL_COMMA: frozenset[Language] = frozenset({"de"})

_Entry = dict[str, str] | str
_PLACES = {"n": r"(\d+)", "axis": "([xyz])"}
_LABEL = re.compile(
    r"(?P<effect>\w+?)(?P<curve> curve)?"
    r"(?: of joint (?P<joint>\d+)| of the (?P<part>links|mounting)| (?P<link>[Ll]\d+))?"
)
"""The diagnosis's label of an effect: `gear_cyclic of joint 1`, `link_length L1`."""


@cache
def _texts(language: Language) -> dict[str, dict[str, _Entry]]:
    content: dict[str, dict[str, _Entry]] = json.loads(
        files("station.messages").joinpath(f"{language}.json").read_text(encoding="utf-8")
    )
    return content


@cache
def templates(language: Language, of: Literal["phrases", "report"]) -> dict[str, str]:
    """The templates of one file, by code."""
    content: dict[str, str] = json.loads(
        files("station.messages").joinpath(f"{language}-{of}.json").read_text(encoding="utf-8")
    )
    return content


def display_name(group: Group, id: str, language: Language = "en") -> str:
    """The name of an effect, parameter, plan, state, verdict, outcome or kind of run.  :raises KeyError:"""
    return _name(_texts(language)[group][id])


def explanation(group: Group, id: str, language: Language = "en") -> str:
    """Its explanation in one sentence. :raises KeyError:"""
    entry = _texts(language)[group][id]
    return "" if isinstance(entry, str) else entry["text"]


def certificate_text(key: str, language: Language) -> str:
    """A label or sentence of the certificate, with placeholders. :raises KeyError:"""
    return _text("certificate", key, language)


def reasons(language: Language = "en") -> dict[str, str]:
    """The sentence of every reason, by its code."""
    return {code: text for code, text in _texts(language)["reasons"].items() if isinstance(text, str)}


def reason_template(code: str, language: Language = "en") -> str:
    """The sentence of a reason, with placeholders. :raises KeyError:"""
    return _text("reasons", code, language)


def report_template(key: str, language: Language) -> str:
    """A label or sentence of the report on a diagnosis, with placeholders. :raises KeyError:"""
    return templates(language, "report")[key]


def parameter_name(id: str, language: Language) -> str:
    """The name of a parameter, also with a number or an axis; the identifier itself if it has no name."""
    return _open_name("parameters", id, language)


def part_name(id: str, language: Language) -> str:
    """The part on which an effect acts, for the middle of a sentence."""
    return _open_name("parts", id, language)


def dependence_name(id: str, language: Language) -> str:
    """The quantity that a residual depends on, for the middle of a sentence."""
    return _open_name("dependences", id, language)


def effect_name(label: str, language: Language) -> str:
    """The name of an effect by its label, for instance `backlash of joint 1`; also of an unnamed one."""
    known = _LABEL.fullmatch(label)
    entry = _texts(language)["effects"].get(known["effect"]) if known else None
    if known is None or entry is None:
        return _open_name("labels", label, language)
    name = _name(entry)
    if known["curve"]:
        name = certificate_text("curve", language).format(effect=name)
    if known["joint"]:
        return certificate_text("of_joint", language).format(effect=name, joint=known["joint"])
    if part := known["part"] or known["link"]:
        return certificate_text("of_part", language).format(effect=name, part=part_name(part, language))
    return name


def labels_in_words(labels: str, language: Language) -> str:
    """Effects by their labels with "and" between them, for the middle of a sentence."""
    return both(
        [_in_sentence(effect_name(label, language), language) for label in labels.split(" and ")], language
    )


def both(parts: Sequence[str], language: Language) -> str:
    """Parts of a sentence as a list that ends with "and"."""
    *others, last = parts
    first = report_template("between", language).join(others)
    return certificate_text("and", language).join([first, last]) if others else last


def _in_sentence(name: str, language: Language) -> str:
    """German nouns keep their capital; so do abbreviations."""
    return name[:1].lower() + name[1:] if language == "en" and not name[1:2].isupper() else name


def _text(group: str, key: str, language: Language) -> str:
    entry = _texts(language)[group][key]
    assert isinstance(entry, str)
    return entry


def _name(entry: _Entry) -> str:
    return entry if isinstance(entry, str) else entry["name"]


def _open_name(group: str, id: str, language: Language) -> str:
    entries = _texts(language)[group]
    if id in entries:
        return _name(entries[id])
    for key, entry in entries.items():
        place = re.search(r"\{(\w+)\}", key)
        if place is None:
            continue
        form = re.escape(key).replace(re.escape(place[0]), _PLACES[place[1]])
        if found := re.fullmatch(form, id):
            return _name(entry).replace(place[0], found[1])
    return id
