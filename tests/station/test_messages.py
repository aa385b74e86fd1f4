"""Everything that a person may meet by an identifier has a display name and a sentence."""

from __future__ import annotations

from collections.abc import Iterable
from typing import get_args

import pytest

from station.effects import arm_catalogue, five_bar_catalogue
from station.messages import Group, display_name, explanation
from station.plans import PLANS
from station.records import Outcome, State, Verdict
from station.run_kinds import RUN_KINDS

EFFECTS = {effect.id for effect in (*five_bar_catalogue(), *arm_catalogue(6, by_range=True))}


@pytest.mark.parametrize(
    ("group", "ids"),
    [
        ("effects", EFFECTS),
        ("plans", PLANS),
        ("run_kinds", RUN_KINDS),
        ("states", State),
        ("verdicts", get_args(Verdict)),
        ("outcomes", get_args(Outcome)),
    ],
)
def test_all_have_a_name_and_a_sentence(group: Group, ids: Iterable[str]) -> None:
    for id in ids:
        assert display_name(group, id)[0].isupper()
        assert explanation(group, id).endswith(".")
