"""What reaches the page as an English sentence is known to the page in every language."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from station.messages import LANGUAGES
from station.motion.interlocks import _TEXTS as INTERLOCKS
from station.run_kinds import zero_state

ROOT = Path(__file__).parents[2]
OTHERS = [language for language in LANGUAGES if language != "en"]
MESSAGES = ROOT / "web/ui/src/messages"
BETWEEN = re.compile(r"(?<=[.?!]) (?=[A-Z{])")
KEY = re.compile(r"""^  (\w+|"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*'):""", re.MULTILINE)
FIELD = re.compile(r"\{\w*\}")

REPORTING = {
    "Ask", "Busy", "CalibrationHolds", "DeviceFault", "FieldRefused", "Forbidden", "GarbledReply",
    "HTTPException", "InputRefused", "KeyReused", "LinkLost", "MeasurementSequence", "NotApplicable",
    "NotFound", "NotReady", "NotSignedIn", "RetractView", "StepFailed", "StoreUnavailable", "TooManyTries",
    "add", "problem", "trip",
}  # fmt: skip
"""What is made with a sentence for the page: errors, prompts, titles, states, findings of an examination."""
SHOWN = (
    "drivers/lines", "drivers/scales", "drivers/servos", "station/certificate/facts.py", "station/doctor",
    "station/errors.py", "station/motion", "station/people", "station/records/taught.py",
    "station/records/taught_program.py", "station/run_kinds", "station/service", "station/store",
    "web/late.py", "web/problems.py", "web/routes",
)  # fmt: skip
ELSEWHERE = (
    "drivers/lines/url.py", "station/people/openid.py", "station/people/provider.py",
    "station/run_kinds/arm_log.py", "station/run_kinds/import_file.py", "station/service/entrance.py",
    "station/service/replaying.py", "station/service/runtime.py", "station/store/opening.py",
    "station/motion/devices.py", "station/motion/emulated_rig.py", "station/run_kinds/gauge_report.py",
    "station/store/connections.py", "web/routes/robots.py",
)  # fmt: skip
"""Starting a station, importing files and managing it from a terminal: shown there, not on the page."""


def said() -> list[str]:
    return sorted({*zero_state._TEXTS.values(), *INTERLOCKS.values()})


def known_in(language: str) -> set[str]:
    """Every sentence that the page has in this language, its fields without their names."""
    found: set[str] = set()
    for file in MESSAGES.glob(f"{language}-*s.ts"):
        for key in KEY.findall(file.read_text()):
            found.add(FIELD.sub("{}", key if key.isidentifier() else ast.literal_eval(key)))
    return found


def is_known(text: str, known: set[str]) -> bool:
    return text in known or all(part in known or part == "{}" for part in BETWEEN.split(text))


@pytest.mark.parametrize("language", OTHERS)
def test_each_sentence_is_translated(language: str) -> None:
    known = known_in(language)
    assert len(said()) > 10
    assert [one for one in said() if not is_known(one, known)] == []


def template(node: ast.expr) -> str | None:
    """A text as its source has it, with `{}` for what is filled in; None for what is no text."""
    match node:
        case ast.Constant(value=str(text)):
            return text
        case ast.JoinedStr(values=parts):
            return "".join(str(part.value) if isinstance(part, ast.Constant) else "{}" for part in parts)
    return None


def made(file: Path) -> Iterator[tuple[int, str]]:
    """Line and template of every sentence that a module makes; single words are names, not sentences."""
    for node in ast.walk(ast.parse(file.read_text())):
        if not isinstance(node, ast.Call):
            continue
        name = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
        arguments = [*node.args, *(k.value for k in node.keywords if k.arg in ("detail", "text"))]
        if name in REPORTING:
            texts = (template(argument) for argument in arguments)
            yield from ((node.lineno, text) for text in texts if text and re.search(r"[a-z]{2,} ", text))


@pytest.mark.parametrize("language", OTHERS)
def test_each_refusal_and_report_is_translated(language: str) -> None:
    known = known_in(language)
    files = [
        file
        for path in SHOWN
        for file in ([ROOT / path] if path.endswith(".py") else sorted((ROOT / path).rglob("*.py")))
        if str(file.relative_to(ROOT)) not in ELSEWHERE
    ]
    texts = [(file.relative_to(ROOT), *one) for file in files for one in made(file)]
    assert len(texts) > 150
    missing = [f"{file}:{line}: {text}" for file, line, text in texts if not is_known(text, known)]
    assert missing == []
