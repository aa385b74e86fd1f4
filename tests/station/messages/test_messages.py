"""The message file has a name and a sentence for everything that a person may read."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import get_args

import pytest

import station
from station.effects import arm_catalogue, five_bar_catalogue
from station.messages import (
    LANGUAGES,
    Group,
    Language,
    display_name,
    explanation,
    labels_in_words,
    local_number,
    measured,
    reason_text,
)
from station.plans import PLANS
from station.records import DiagnosisVerdict, Outcome, State, Verdict, because, phrase, reason_in
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


def test_every_phrase_is_used_and_every_phrase_in_use_has_its_text() -> None:
    package = Path(station.__file__).parent
    source = "".join(path.read_text(encoding="utf-8") for path in package.rglob("*.py"))
    codes = set(json.loads((package / "messages/en-phrases.json").read_text(encoding="utf-8")))
    assert set(re.findall(r"\bphrase\(\s*\"(\w+)\"", source)) <= codes
    assert [code for code in codes if f'"{code}"' not in source] == []


def test_every_text_of_the_report_is_in_use() -> None:
    package = Path(station.__file__).parent
    source = "".join(path.read_text(encoding="utf-8") for path in package.rglob("*.py"))
    keys = json.loads((package / "messages/en-report.json").read_text(encoding="utf-8"))
    # those that are put together: of a stage, of what was guessed, of the extent
    keys = [key for key in keys if not key.startswith(("stage_", "guessed_", "predicted_"))]
    assert len(keys) > 60
    assert [key for key in keys if f'"{key}"' not in source] == []


def test_a_phrase_is_said_with_its_parts_in_each_language() -> None:
    joints = tuple(phrase("joint", number=number) for number in (1, 2))
    said = phrase("ratio_by_factor", joints=joints, factor=1.25)
    assert (
        said.text() == "[joints] ratio or counts_per_rev of joint 1 and joint 2 is wrong by a factor of 1.25"
    )
    assert "von Gelenk 1 und Gelenk 2 ist um den " in said.text("de")
    assert " 1,25 falsch" in said.text("de")
    assert "关节 1和关节 2" in said.text("zh")
    with pytest.raises(KeyError):
        phrase("ratio_by_factor", joints=joints)
    rows = phrase("rows", count=2)
    text = phrase("glitches", rows=rows, largest_mm=1.0, rms_um=2.0)
    reason = because("adequate_mistake", causes="", share_percent=0.0, text=text)
    assert reason.text.startswith(
        "The model fits the readings, but nothing is confirmed: Column scale_mm: 2 "
    )
    assert reason_in(reason.code, reason.params, "de").endswith("sie werden weggelassen.")


def test_a_phrase_has_a_capital_if_it_is_a_whole_sentence() -> None:
    assert phrase("in_inches").text() == "inches"
    repeated = phrase("pasted_rows", rows=phrase("rows", count=2), source=phrase("reading", id=9))
    assert repeated.text().startswith("2 rows repeat all columns of reading 9: ")
    moved = phrase("pasted_rows", rows=phrase("reading", id=7), source=phrase("reading", id=9))
    assert moved.text().startswith("Reading 7 repeat")
    assert phrase("residual_time").text("zh") == "残差随时间变化。"


def test_an_effect_has_its_name_in_a_sentence() -> None:
    labels = "gear_cyclic curve of joint 1 and unnamed error by place and no effect"
    assert labels_in_words(labels, "en") == (
        "gear ripple curve of joint 1, unnamed error by position and no effect"
    )
    assert labels_in_words(labels, "de").startswith("Getriebewelligkeit, Kurve von Gelenk 1, unbenannter ")
    refuted = because(
        "unexplained_refuted", causes="gear_cyclic of joint 1", share_percent=4.0, depends_on="time"
    )
    assert refuted.text.startswith("Not explained: gear ripple of joint 1 took 4.0 %")
    explained = because("explained", causes="gear_cyclic of joint 1", share_percent=93.0)
    assert explained.text.startswith("Gear ripple of joint 1 explained 93.0 %")
    # the start of another sentence stays as it was written
    assert because("refused", text="log.csv: row 3 is empty").text == "log.csv: row 3 is empty"


def texts_of(language: str) -> dict[str, str]:
    """Every text by its path."""
    found: dict[str, str] = {}

    def collect(value: object, path: str) -> None:
        if isinstance(value, dict):
            for key, part in value.items():
                collect(part, f"{path}/{key}")
        else:
            found[path] = str(value)

    folder = Path(station.__file__).parent / "messages"
    for name in (language, f"{language}-phrases", f"{language}-report"):
        collect(json.loads((folder / f"{name}.json").read_text(encoding="utf-8")), name[len(language) :])
    return found


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_language_has_every_text_with_the_same_places_for_values(language: Language) -> None:
    english, other = texts_of("en"), texts_of(language)
    assert english.keys() == other.keys()
    for path, text in english.items():
        places = [sorted(re.findall(r"\{[^}]*\}", one)) for one in (text, other[path])]
        assert places[0] == places[1], path


@pytest.mark.parametrize("language", [one for one in LANGUAGES if one != "en"])
def test_a_language_is_not_english_by_another_name(language: Language) -> None:
    english = texts_of("en")
    same = [path for path, text in texts_of(language).items() if text == english[path]]
    assert len(same) < 0.06 * len(english), same


def test_numbers_dates_and_identifiers_are_written_as_the_language_writes_them() -> None:
    params: dict[str, float | int | str] = {
        "causes": "backlash of joint 2 and link_length L1",
        "share_percent": 93.25,
        "depends_on": "joint1",
    }
    german = reason_text("partly_explained", params, "de")
    assert german.startswith(
        "Getriebespiel von Gelenk 2 und Fehler der Gliedlänge von gestellnahem Glied 1: "
    )
    assert "93,2 %" in german and german.endswith("Winkel von Gelenk 1.")
    assert reason_text("partly_explained", params, "zh").startswith("关节 2 的齿轮间隙和近架杆 1的杆长误差")
    assert measured(-0.05, 0.0123, "deg", "de") == "\u22120,050 ± 0,012\u00a0°"
    assert measured(-0.05, 0.0123, "deg", "en") == "\u22120.050 ± 0.012\u00a0°"
    assert measured(12.0, None, "mm", "en") == "12.0000\u00a0mm"
    assert local_number(-0.0001, 2, "en") == "0.00"
    assert local_number(float("nan"), 2, "de") == "–"
