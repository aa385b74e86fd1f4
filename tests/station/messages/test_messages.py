"""The message file has a name and a sentence for everything that a person may read."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import get_args

import pytest

import station
from station.effects import arm_catalogue, five_bar_catalogue
from station.messages import Group, display_name, explanation
from station.plans import PLANS
from station.records import DiagnosisVerdict, Outcome, State, Verdict
from station.run_kinds import RUN_KINDS

EFFECTS = {
    effect.id for effect in (*five_bar_catalogue(), *arm_catalogue(6, by_range=True, timed=True, warmed=True))
}

NAMED: list[tuple[Group, tuple[str, ...]]] = [
    ("effects", tuple(sorted(EFFECTS))),
    ("states", tuple(State)),
    ("outcomes", get_args(Outcome)),
    ("verdicts", (*get_args(Verdict), *get_args(DiagnosisVerdict))),
    ("plans", tuple(PLANS)),
    ("run_kinds", tuple(RUN_KINDS)),
]


def test_no_group_is_empty() -> None:
    assert all(ids for _, ids in NAMED)


@pytest.mark.parametrize(
    ("group", "id"), [(group, id) for group, ids in NAMED for id in ids], ids=lambda part: str(part)
)
def test_everything_that_is_shown_has_a_name_and_a_sentence(group: Group, id: str) -> None:
    assert display_name(group, id)[0].isupper()
    assert explanation(group, id).endswith(".")


def test_every_reason_in_the_code_is_a_reason_of_the_message_file() -> None:
    """`because` checks its code when it is called; here those that no test happens to call."""
    package = Path(station.__file__).parent
    source = "".join(path.read_text(encoding="utf-8") for path in package.rglob("*.py"))
    codes = set(re.findall(r"\bbecause\(\s*\"(\w+)\"", source))
    assert len(codes) > 10
    assert codes <= set(json.loads((package / "messages/en.json").read_text(encoding="utf-8"))["reasons"])
