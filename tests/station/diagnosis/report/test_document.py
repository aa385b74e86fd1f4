"""`station diagnose`: the contract's JSON, exit status, terminal and page."""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path
from typing import Any, Literal

import pytest
from click.testing import CliRunner
from pydantic import BaseModel, ConfigDict, Field

from station.cli import main
from station.effects import five_bar_catalogue
from tests.station.simulated import Drawn, to_csv

BACKLASH = {"kind": "backlash", "joint": 1, "width_deg": 0.01}
DRAG = {"kind": "cable_drag", "joint": 1, "deg_at_end": 0.01}


class Strict(BaseModel):
    model_config = ConfigDict(allow_inf_nan=False, strict=True)


class Data(Strict):
    file: str
    readings: int
    sha256: str


class Noise(Strict):
    sigma_mm: float
    source: Literal["repeats", "specification"]
    dof: int


class Quantity(Strict):
    name: str
    value: float
    sd: float
    unit: str


class Weak(Strict):
    singular_ratio: float
    text: str
    sd_deg: float


class Member(Strict):
    effect: str
    joint: Literal[1, 2] | None
    part: str | None


class FindingBody(Member):
    parameters: list[Quantity]
    share: float
    p_value: float
    probability: float
    alias_set: list[Member]
    remedy: str
    separating_experiment: str | None


class StageBody(Strict):
    model: str
    unknowns: int
    fit_rms_mm: float
    holdout_rms_mm: float
    holdout_max_mm: float
    confirm_rms_mm: float | None
    confirm_max_mm: float | None


class PositionError(Strict):
    rms: float
    max: float
    bound_95: float


class ExplainedBody(Member):
    parameters: list[Quantity]
    depends_on: Literal["joint1", "joint2", "reading", "place", "time", "approach"] | None


class ExplanationBody(Strict):
    effects: list[ExplainedBody]
    probability: float
    named: bool


class ExperimentBody(Strict):
    kind: str
    text: str
    decides: float


class MistakeBody(Strict):
    kind: str
    text: str
    rows: list[int | str]


class EndStage(StageBody):
    predicted_position_error_mm: PositionError


class HintBody(Strict):
    depends_on: str
    strength: float
    text: str


class Invisible(Member):
    minimum_detectable: float | None
    unit: str | None


class Document(Strict):
    """Contract.md, `station diagnose --json`."""

    schema_: Literal["station.diagnosis/2"] = Field(alias="schema")
    data: Data
    noise: Noise
    verdict: Literal["adequate", "explained", "ambiguous", "partly_explained", "unexplained"]
    confirmed: bool | None
    parameters: list[Quantity]
    weak_direction: Weak
    findings: list[FindingBody]
    stages: list[StageBody]
    before: EndStage
    after: EndStage
    hints: list[HintBody]
    invisible: list[Invisible]
    outliers: list[int | str]
    explanations: list[ExplanationBody]
    experiments: list[ExperimentBody]
    mistake: MistakeBody | None
    model: dict[str, Any]


class Run:
    """One `station diagnose` on files of an emulated machine."""

    def __init__(self, folder: Path, effect: dict[str, Any] | None, *, confirm: bool = True) -> None:
        machine = Drawn(*([effect] if effect else []), seed=1, recorded_temperature=False)
        self.data = folder / "walk.csv"
        self.data.write_text(to_csv(machine.sequence()))
        fresh = folder / "fresh.csv"
        fresh.write_text(to_csv(machine.fresh()))
        self.page = folder / "page.html"
        out = folder / "out.json"
        arguments = ["diagnose", str(self.data), "--json", str(out), "--html", str(self.page)]
        self.result = CliRunner().invoke(
            main, [*arguments, "--confirm", str(fresh)] if confirm else arguments
        )
        assert self.result.exception is None or isinstance(self.result.exception, SystemExit)
        text = out.read_text()
        assert "NaN" not in text
        assert "Infinity" not in text
        self.json = json.loads(text)
        self.document = Document.model_validate_json(text)


@pytest.fixture(scope="module")
def explained(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return Run(tmp_path_factory.mktemp("explained"), BACKLASH)


@pytest.fixture(scope="module")
def unexplained(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return Run(tmp_path_factory.mktemp("unexplained"), DRAG)


def test_explained_document(explained: Run) -> None:
    d = explained.document
    assert explained.result.exit_code == 0
    assert (d.verdict, d.confirmed) == ("explained", True)
    assert d.data.readings == 120
    assert d.data.sha256 == hashlib.sha256(explained.data.read_bytes()).hexdigest()
    assert (d.noise.source, d.noise.dof > 10) == ("repeats", True)
    assert [q.name for q in d.parameters[:2]] == ["dtheta1", "dtheta2"]
    assert [q.unit for q in d.parameters[:3]] == ["deg", "deg", "mm"]
    (finding,) = d.findings
    assert (finding.effect, finding.joint) == ("backlash", 1)
    assert finding.alias_set[0].model_dump() == {"effect": "backlash", "joint": 1, "part": "joint1"}
    assert 0.95 < finding.share <= 1.0
    assert [s.model for s in d.stages] == ["paper", "base", "+ backlash of joint 1"]
    assert [s.unknowns for s in d.stages] == [4, 12, 13]
    assert d.before.model == "base"
    assert d.after.model == "+ backlash of joint 1"
    assert d.after.predicted_position_error_mm.rms < d.before.predicted_position_error_mm.rms
    assert d.after.predicted_position_error_mm.rms <= d.after.predicted_position_error_mm.max
    assert d.stages[2].confirm_rms_mm is not None
    assert d.stages[1].confirm_rms_mm is not None
    assert d.stages[2].confirm_rms_mm < 0.3 * d.stages[1].confirm_rms_mm
    assert d.hints == []
    assert finding.probability > 0.95
    (best, *_) = d.explanations
    assert [(e.effect, e.joint) for e in best.effects] == [("backlash", 1)]
    assert (best.named, best.probability > 0.95) == (True, True)
    assert (d.experiments, d.mistake) == ([], None)
    after = d.after.predicted_position_error_mm
    assert after.max <= after.bound_95 * 1.5
    assert d.model["schema"] == "station.model/2"
    assert ("scale_gain", None) in [(i.effect, i.joint) for i in d.invisible]


def test_unexplained_document(unexplained: Run) -> None:
    d = unexplained.document
    assert unexplained.result.exit_code == 1
    assert d.verdict in ("unexplained", "partly_explained", "ambiguous")
    assert d.confirmed is False
    assert d.hints[0].depends_on == "approach x place"
    assert [h.strength for h in d.hints] == sorted((h.strength for h in d.hints), reverse=True)
    assert d.model["confirmed"] is False
    assert any(e.effect == "unnamed" and e.depends_on for one in d.explanations for e in one.effects)


def test_without_fresh_readings_nothing_is_confirmed(tmp_path: Path) -> None:
    d = Run(tmp_path, BACKLASH, confirm=False)
    assert d.result.exit_code == 0
    assert d.document.confirmed is None
    assert [s.confirm_rms_mm for s in d.document.stages] == [None, None, None]
    assert "No fresh readings confirm it" in d.json["sentence"]


def test_clean_document(tmp_path: Path) -> None:
    run = Run(tmp_path, None)
    assert run.result.exit_code == 0
    assert (run.document.verdict, run.document.findings) == ("adequate", [])
    assert len(run.document.stages) == 2
    assert run.document.before.fit_rms_mm == run.document.after.fit_rms_mm
    assert len(run.document.invisible) == 25


def test_terminal_says_it_in_words(explained: Run, unexplained: Run) -> None:
    assert explained.result.output.startswith("Backlash of joint 1 explained 9")
    assert "reducer" in explained.result.output
    assert "Hint: " in unexplained.result.output


def test_effects_have_their_names_on_the_terminal_and_on_the_page_and_their_labels_in_the_document(
    explained: Run, unexplained: Run
) -> None:
    ids = [effect.id for effect in five_bar_catalogue() if "_" in effect.id]
    for run in (explained, unexplained):
        assert [id for id in ids if id in run.result.output + run.page.read_text()] == []
    assert "Gear ripple of joint 1" in explained.page.read_text()
    assert "gear_cyclic of joint 1" in [one["label"] for one in explained.json["invisible"]]


def test_page_needs_nothing_but_itself(explained: Run) -> None:
    text = explained.page.read_text()
    assert not re.findall(r"(?:src|href)=[\"'](?!#)", text)
    assert "http" not in text
    assert "@import" not in text
    # order, time, two angles, travel, two approaches and the map, before and after
    assert text.count("<svg") == 16
    assert "the effects account for" in text
    assert "Adjust or replace the reducer" in text
    assert "What these readings could not have shown" in text


def test_page_of_the_unexplained_says_on_what_it_depends(unexplained: Run) -> None:
    text = unexplained.page.read_text()
    assert "What the rest depends on" in text
    assert '<td class="text">Unnamed error by approach' in text
    assert "something drags on the platform" in text


def test_every_effect_is_documented() -> None:
    text = (Path(__file__).parents[4] / "docs/reference/names.md").read_text(encoding="utf-8")
    for effect in five_bar_catalogue():
        assert f"| `{effect.id}` |" in text
