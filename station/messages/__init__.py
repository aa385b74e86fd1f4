"""What people read: display names, explanations and reasons, in one file for each language (`en.json`).

The page reads the same file; what travels over REST is a code with parameters beside the English sentence.
"""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import Literal

Group = Literal[
    "effects", "parameters", "plans", "states", "verdicts", "outcomes", "run_kinds", "dependences"
]


@cache
def _texts() -> dict[str, dict[str, dict[str, str] | str]]:
    content: dict[str, dict[str, dict[str, str] | str]] = json.loads(
        files(__name__).joinpath("en.json").read_text(encoding="utf-8")
    )
    return content


def display_name(group: Group, id: str) -> str:
    """The name of an effect, parameter, plan, state, verdict, outcome or kind of run.  :raises KeyError:"""
    entry = _texts()[group][id]
    return entry if isinstance(entry, str) else entry["name"]


def explanation(group: Group, id: str) -> str:
    """What it is, in one sentence.  :raises KeyError:"""
    entry = _texts()[group][id]
    return "" if isinstance(entry, str) else entry["text"]


def reasons() -> dict[str, str]:
    """The sentence of every reason, by its code."""
    return {code: text for code, text in _texts()["reasons"].items() if isinstance(text, str)}


def reason_text(code: str, params: dict[str, float | int | str]) -> str:
    """A reason in a sentence.  :raises KeyError: an unknown code, or a parameter that its sentence needs."""
    template = _texts()["reasons"][code]
    assert isinstance(template, str)
    return template.format_map(params)
