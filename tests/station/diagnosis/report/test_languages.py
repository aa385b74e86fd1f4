"""The report in each language: its words, its numbers, and what it was found from."""

from __future__ import annotations

import html
import re
from collections import Counter
from pathlib import Path

import pytest
from click.testing import CliRunner

from station.cli import main
from station.diagnosis import Findings, WeighedFindings, page
from station.diagnosis.report.wording import Wording
from station.fitting import Outlier
from station.fitting.separability import Tied
from station.messages import LANGUAGES, Language
from station.records import DataSource, Dependence, Phrase, ReasonValue, phrase, reason_in
from station.report import Series as Drawn
from station.report import Table, Words, line, place_map
from station.run_kinds import diagnosed
from tests.station.run_kinds.test_diagnose import BACKLASH, DRAG, ROBOT, machine, run

SAME_EVERYWHERE = {"csv", "kg", "log", "mm", "ppm"}
"""Units, and what is diagnosed."""


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
    assert english & words(shown(pages["de"])) <= SAME_EVERYWHERE | {"Drift", "an", "in", "so", "um", "was"}
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


def test_every_text_of_a_document_has_a_code_that_says_the_same_in_english(findings: Findings) -> None:
    document = findings.document(DataSource(file="log.csv", readings=1, sha256=""))
    weak = document.weak_direction
    pairs: list[tuple[str | None, Phrase | None]] = [(one.text, one.said) for one in document.invisible]
    pairs += [(one.text, one.said) for one in document.hints]
    pairs += [(one.text, one.said) for one in document.experiments]
    pairs += [(found.remedy, found.remedy_said) for found in document.findings]
    pairs += [(one.separating_experiment, one.separating_experiment_said) for one in document.findings]
    pairs += [(weak.text, weak.said), (weak.remedy, weak.remedy_said)]
    pairs += [(one.text, one.said) for one in weak.remedies]
    pairs += zip(weak.blind, weak.blind_said, strict=True)
    assert len(pairs) > 10
    assert [(text, said) for text, said in pairs if text and (said is None or said.text() != text)] == []


def test_a_remedy_with_a_wrong_entry_is_in_the_language_of_the_reader() -> None:
    """A gain of both joints is as probable from a wrong ratio in the robot file: both are in the remedy."""
    gains: list[dict[str, object]] = [
        {"kind": "transmission_gain", "joint": joint, "ppm": 3000.0} for joint in (1, 2)
    ]
    found = diagnosed(ROBOT, run(machine(*gains))[0])
    entry = found.diagnosis.entry if isinstance(found, WeighedFindings) else None
    assert entry is not None
    [first, *_] = found.document(DataSource(file="log.csv", readings=1, sha256="")).findings
    assert first.remedy.endswith(entry.text)
    assert first.remedy_said is not None
    german = first.remedy_said.text("de")
    assert german.endswith(entry.said.text("de"))
    assert words([german]) & {"the", "is", "wrong", "check", "or"} == set()
    assert html.escape(german, quote=False) in page(found, "log.csv", "de").to_html()


def test_the_texts_of_a_record_of_an_older_version_are_in_english() -> None:
    older = {"depends_on": "time", "strength": 0.5, "text": "The residual changes with time."}
    hint = Dependence.model_validate(older)
    assert Wording("de").sentence(hint.said, hint.text) == "The residual changes with time."


def test_an_outlier_is_named_in_each_language() -> None:
    outlier = Outlier(reading=7, residual_mm=-0.0521, times_sd=11.7)
    assert outlier.reason == "off by -52 µm, 12 times the scatter of the others"
    assert outlier.said.text("de") == "weicht um -52 µm ab, das 12-Fache der Streuung der übrigen"


def test_a_parameter_that_is_tied_has_its_name_in_other_languages() -> None:
    said = Tied("dtheta1", ("rMx", "rMy")).said
    assert said.text() == "dtheta1 (looks like rMx, rMy)"
    assert said.text("de").startswith("Nullpunktabweichung von Gelenk 1 (sieht aus wie Anbaufehler")


def test_a_reason_names_explanations_without_a_name_and_their_shares() -> None:
    others = phrase(
        "followed_by",
        first=phrase("share", causes="thermal_growth of the mounting", percent=22.0),
        rest=phrase("share", causes="drift and no effect at all", percent=7.0),
    )
    params: dict[str, ReasonValue] = {
        "causes": "gear_cyclic of joint 1 and unnamed error of joint 2",
        "probability_percent": 61.0,
        "others": others,
        "experiment": phrase("most_useful", percent=83.2, experiment=phrase("experiment_motion", stops=40)),
    }
    assert reason_in("ambiguous", params, "en") == (
        "Not certain: these readings cannot distinguish gear ripple of joint 1 and unnamed error of joint 2 "
        "(61 %) from thermal growth of the scale mounting (22 %), drift and no effect at all (7 %). "
        "Most useful (83 % probable to decide): Read 40 further positions where the explanations differ most."
    )
    german = reason_in("ambiguous", params, "de")
    assert "Getriebewelligkeit von Gelenk 1 und unbenannter Fehler von Gelenk 2 (61 %)" in german
    assert "Wärmedehnung von der Maßstabhalterung (22 %), Drift und keinem " in german
    assert "Am nützlichsten (entscheidet mit 83 % Wahrscheinlichkeit): Messen" in german
    assert "光栅尺安装的热膨胀（22 %）、漂移和无任何效应（7 %）" in reason_in("ambiguous", params, "zh")
    alone = {**params, "others": phrase("other_explanations")}
    assert "von anderen" in reason_in("ambiguous", alone, "de")
    older = {**params, "others": "drift (7 %)", "experiment": "Most useful: read."}
    text = reason_in("ambiguous", older, "de")
    assert "von drift (7 %)" in text and text.endswith(" Most useful: read.")


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
