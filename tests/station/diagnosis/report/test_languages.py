"""The report in each language: its words, its numbers, and what it was found from."""

from __future__ import annotations

import ast
import html
import json
import re
from collections import Counter
from pathlib import Path

import pytest
from click.testing import CliRunner

import station
from station.cli import main
from station.diagnosis import Findings, page
from station.diagnosis.naming import DEPENDENCES, MOUNTING, READING_STEP
from station.effects import arm_catalogue, five_bar_catalogue
from station.messages import LANGUAGES, Language, in_words, reason_text
from station.report import Series as Drawn
from station.report import Table, Words, line, place_map
from station.run_kinds import diagnosed
from tests.station.run_kinds.test_diagnose import BACKLASH, DRAG, ROBOT, machine, run

PACKAGE = Path(station.__file__).parent
SAME_EVERYWHERE = {"csv", "kg", "log", "mm", "ppm"}
"""Units, and what is diagnosed."""
SAYING = (
    "diagnosis/search/dependence.py", "diagnosis/report/detectability.py", "diagnosis/experiments/rating.py",
    "diagnosis/tests_of_fit/confirmation.py", "five_bar/weak_direction.py", "fitting/outliers.py",
    "fitting/separability.py",
)  # fmt: skip
"""Modules whose sentences reach the report as they are in English."""


@pytest.fixture(scope="module", params=[BACKLASH, DRAG], ids=["backlash", "drag"])
def findings(request: pytest.FixtureRequest) -> Findings:
    return diagnosed(ROBOT, run(machine(request.param))[0])


def shown(document: str) -> list[str]:
    """Every text that a reader sees, hears or points at, without the title of what was diagnosed."""
    body = re.sub(r"<style>.*?</style>", "", document, flags=re.DOTALL)
    texts = [*re.findall(r'aria-label="([^"]*)"', body), *re.split(r"<[^>]*>", body)]
    return [html.unescape(text) for text in texts if text.strip()]


def words(texts: list[str]) -> set[str]:
    return {word for text in texts for word in re.findall(r"[A-Za-z][A-Za-z_]+", text)}


def test_chinese_and_german_pages_have_no_english_words(findings: Findings) -> None:
    pages = {language: page(findings, "log.csv", language).to_html() for language in LANGUAGES}
    assert words(shown(pages["zh"])) <= SAME_EVERYWHERE
    english = words(shown(pages["en"]))
    assert len(english) > 150
    # words that are also German
    assert english & words(shown(pages["de"])) <= SAME_EVERYWHERE | {"an", "in", "so", "um", "was"}
    for language, text in pages.items():
        assert text.startswith(f'<!doctype html>\n<html lang="{language}">')


def test_numbers_are_the_same_in_each_language(findings: Findings) -> None:
    numbers = {}
    for language in LANGUAGES:
        sign = "," if language == "de" else "."
        found = re.findall(rf"\d+(?:{re.escape(sign)}\d+)?", " ".join(shown_of(findings, language)))
        numbers[language] = Counter(number.replace(sign, ".") for number in found)
    # the reading's offset is called `rho0` in English
    numbers["en"]["0"] -= 1
    assert numbers["en"] == numbers["zh"] == numbers["de"]
    assert sum(numbers["en"].values()) > 500


def shown_of(findings: Findings, language: Language) -> list[str]:
    return shown(page(findings, "log.csv", language).to_html())


def test_each_sentence_of_a_diagnosis_has_its_translation() -> None:
    known = [json.loads((PACKAGE / f"messages/{one}-sentences.json").read_text()) for one in ("de", "zh")]
    assert known[0].keys() == known[1].keys()
    for english, *others in ((key, known[0][key], known[1][key]) for key in known[0]):
        places = Counter(re.findall(r"\{\w*\}", english))
        assert all(Counter(re.findall(r"\{\w*\}", other)) == places for other in others), english
    effects = (*five_bar_catalogue(), *arm_catalogue(6, by_range=True))
    whole = {text for one in effects for text in (one.physics, one.remedy, one.experiment)}
    whole |= {text for one in (MOUNTING, READING_STEP) for text in (one.physics, one.remedy, one.experiment)}
    whole |= {f"unnamed error {on}" for on in DEPENDENCES.values()}
    untold = [text for text in whole if in_words(text, "zh") == text]
    keys = " | ".join(without_values(key) for key in known[0])
    pieces = [piece for file in SAYING for piece in pieces_in(PACKAGE / file)]
    assert len(pieces) > 25
    assert untold + [piece for piece in pieces if piece not in keys] == []


def without_values(text: str) -> str:
    return re.sub(r"\{\w*\}|\d+", "{}", text)


def pieces_in(file: Path) -> list[str]:
    """What a module says, between the values: not its docstrings and not what it refuses."""
    tree = ast.parse(file.read_text())
    unsaid = {
        id(part)
        for node in ast.walk(tree)
        if isinstance(node, ast.Raise)
        or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant))
        for part in ast.walk(node)
    }
    said = [node for node in ast.walk(tree) if isinstance(node, ast.Constant) and id(node) not in unsaid]
    texts = [without_values(node.value) for node in said if isinstance(node.value, str)]
    return [one for text in texts for one in text.split("{}") if re.search(r"[a-z]{2,} [a-z]{2,}", one)]


def test_a_sentence_is_known_with_its_numbers_and_the_sentences_in_it() -> None:
    text = (
        "Most useful (83 % probable to decide): Read 40 further positions where the explanations differ most."
    )
    assert in_words(text, "en") == text
    assert in_words(text, "de").startswith(
        "Am nützlichsten (entscheidet mit 83 % Wahrscheinlichkeit): Messen"
    )
    wave = "The residual follows the angle of joint 2, about 1.25e+03 times a turn."
    assert (
        in_words(wave, "de")
        == "Der Restfehler folgt dem Winkel von Gelenk 2, etwa 1,25e+03-mal je Umdrehung."
    )
    assert (
        in_words("The residual follows the temperature. Nobody knows.", "zh")
        == "残差随温度变化。Nobody knows."
    )
    tied = "dtheta1 (looks like rMx, rMy)"
    assert in_words(tied, "de").startswith("Nullpunktabweichung von Gelenk 1 (sieht aus wie Anbaufehler")


def test_a_reason_names_explanations_without_a_name_and_their_shares() -> None:
    params: dict[str, float | int | str] = {
        "causes": "backlash of joint 1 and unnamed error of joint 2",
        "probability_percent": 61.0,
        "others": "thermal_growth of the mounting (22 %), drift and no effect at all (7 %)",
        "experiment": "",
    }
    german = reason_text("ambiguous", params, "de")
    assert "Getriebespiel von Gelenk 1 und unbenannter Fehler von Gelenk 2 (61 %)" in german
    assert "Wärmedehnung von der Maßstabhalterung (22 %), Drift und keinem " in german
    assert "光栅尺安装的热膨胀（22 %）、漂移和无任何效应（7 %）" in reason_text("ambiguous", params, "zh")
    assert "von anderen" in reason_text("ambiguous", {**params, "others": "others"}, "de")


def test_a_chart_has_decimal_commas_and_the_words_of_its_language() -> None:
    german = Words("de", ",", "Inhalt", "{y} über {x}", "minus", "über; bis {size}")
    drawn = line([Drawn("eins", [0.0, 0.5], [1.25, 2.5])], "x", "y", words=german)
    assert 'aria-label="y über x"' in drawn and "<title>eins: 0,5; 2,5</title>" in drawn and ">0,1<" in drawn
    drawn = place_map([1.0, 2.0], [3.0, 4.0], [-0.5, 1.25], "µm", words=german)
    assert "über; bis 1,25 µm" in drawn and "<title>x 1, y 3 mm: -0,5 µm</title>" in drawn


def test_a_column_of_words_stands_at_the_left_whole() -> None:
    table = Table(("a", "b", "c"), [("x", "short", 1.0), ("y", "long enough to be broken in two", 2.0)])
    assert table.in_words == (False, True, False)
    assert Table(("a", "b"), []).in_words == (False, False)


def test_the_command_writes_the_page_in_the_language_asked_for(tmp_path: Path) -> None:
    refused = CliRunner().invoke(main, ["diagnose", str(tmp_path / "none.csv"), "--language", "tlh"])
    known = ", ".join(f"'{language}'" for language in LANGUAGES)
    assert (refused.exit_code, f"'tlh' is not one of {known}" in refused.output) == (2, True)
