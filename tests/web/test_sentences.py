"""What reaches the page as an English sentence is known to the page in every language."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from station.diagnosis import naming
from station.effects import five_bar_catalogue
from station.identification.bound import PLAN_ENDED
from station.run_kinds import zero_state

MESSAGES = Path(__file__).parents[2] / "web/ui/src/messages"
BETWEEN = re.compile(r"(?<=[.?!]) (?=[A-Z])")


def said() -> list[str]:
    effects = [naming._catalogue()[effect.label] for effect in five_bar_catalogue()]
    texts = [*zero_state._TEXTS.values(), PLAN_ENDED, naming.UNNAMED_REMEDY, naming.UNNAMED_EXPERIMENT]
    for named in (*effects, naming.MOUNTING, naming.READING_STEP):
        texts += [named.remedy, named.experiment]
    return sorted(set(texts))


@pytest.mark.parametrize("language", ["de", "zh"])
def test_each_sentence_is_translated(language: str) -> None:
    file = (MESSAGES / f"{language}-sentences.ts").read_text()

    def known(text: str) -> bool:
        return f"{json.dumps(text, ensure_ascii=False)}:" in file

    assert len(said()) > 30
    assert [one for one in said() if not (known(one) or all(map(known, BETWEEN.split(one))))] == []
