"""Joint commands over HTTP under the model of a run, and what the true machine does with them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from station.diagnosis.explanations import Around
from station.diagnosis.weighed_loop import weighed
from station.records import Complex, Phrase, Real
from tests.station.diagnosis.learned.test_commands import BACKLASH, rms, true_error_mm
from tests.station.simulated import ROBOT, Drawn, to_csv
from tests.web.conftest import Service
from tests.web.test_problems import problem_of

LIST = "/api/v1/calibrations"
WARM = {"kind": "thermal_growth", "rise_k": 8.0, "tau_s": 60.0, "links_um_per_m_per_k": 12.0}


def imported(service: Service, sequence: str, fresh: str) -> str:
    """A machine's readings as a run; its address."""
    answer = service.client.post(
        "/api/v1/datasets", files={"file": ("w.csv", sequence), "fresh": ("f.csv", fresh)}
    )
    assert (answer.json()["verdict"], answer.json()["outcome"]) == ("fail", "repair"), answer.text
    return str(answer.headers["location"])


@pytest.fixture
def worn(service: Service) -> str:
    machine = Drawn(BACKLASH, seed=2)
    return imported(service, to_csv(machine.sequence()), to_csv(machine.fresh()))


def targets(place: Complex, approach: Real) -> list[dict[str, Any]]:
    return [
        {"x_mm": p.real, "y_mm": p.imag, "approach1": int(a), "approach2": int(b)}
        for p, (a, b) in zip(place, approach, strict=True)
    ]


def test_the_true_position_error_falls(service: Service) -> None:
    machine = Drawn(BACKLASH, seed=2)
    sequence = machine.sequence()
    where = imported(service, to_csv(sequence), to_csv(machine.fresh()))
    place = ROBOT.workspace_grid(7, 5)
    approach = np.random.default_rng(0).choice([-1.0, 1.0], (len(place), 2))
    answer = service.client.post(f"{where}/solve", json={"targets": targets(place, approach)})
    assert answer.status_code == 200
    solution = answer.json()
    assert solution["confirmed"] is True
    assert "with backlash of joint 1" in solution["range"]
    after = np.radians([[c["theta1_deg"], c["theta2_deg"]] for c in solution["commands"]])
    found = weighed(ROBOT, sequence).found
    before = found.mixture.only(found.base).commands(place, Around(approach))
    was, now = (rms(true_error_mm(machine, place, approach, theta)) for theta in (before, after))
    assert now < 0.5 * was


REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "out of reach": ({"y_mm": -2500}, "targets.1.x_mm", "out of reach"),
    "beyond the range": ({"x_mm": -420}, "targets.1.x_mm", "was learned from"),
    "no approach": ({"approach1": 0}, "targets.1.approach1", "depends on it"),
    "no direction": ({"approach1": 2}, "targets.1.approach1", "-1"),
    "not a number": ({"y_mm": "here"}, "targets.1.y_mm", "number"),
    "unknown field": ({"z_mm": 1}, "targets.1.z_mm", "not permitted"),
    "a temperature here only": ({"temperature_c": 20}, "targets.0.temperature_c", "give it for all"),
}


@pytest.mark.parametrize("name", list(REFUSED))
def test_a_refusal_names_target_and_field(service: Service, worn: str, name: str) -> None:
    change, field, said = REFUSED[name]
    good = {"x_mm": 0, "y_mm": -700, "approach1": 1, "approach2": 1}
    document = problem_of(
        service.client.post(f"{worn}/solve", json={"targets": [good, {**good, **change}]}), 422
    )
    assert document["field"] == field
    assert said in document["detail"]
    if "said" in document:
        assert Phrase(**document["said"]).text() == document["detail"]


def test_a_refusal_has_a_code_for_other_languages(service: Service, worn: str) -> None:
    """English beside it, with numbers in the form of the language and the display name of the effect."""
    target = {"x_mm": 0, "y_mm": -2500.5, "approach1": 1, "approach2": 1}
    refusals = [
        problem_of(service.client.post(f"{worn}/solve", json={"targets": [{**target, **change}]}), 422)
        for change in ({}, {"y_mm": -700, "approach1": 0})
    ]
    far, missing = (Phrase(**document["said"]) for document in refusals)
    assert far.text("de") == (
        "Ziel 0, x_mm, y_mm: Position (0,0; -2500,5) mm ist nicht erreichbar;"
        " Ziele müssen im Arbeitsraum liegen."
    )
    assert missing.text("de") == (
        "Ziel 0, approach1: fehlt oder ist 0, davon hängt aber ab: Getriebespiel von Gelenk 1;"
        " geben Sie -1 oder 1 an."
    )
    assert missing.text("zh").startswith("目标 0，approach1：缺失或为 0，但“")


def test_none_and_too_many_targets_are_refused(service: Service, worn: str) -> None:
    place = {"x_mm": 0, "y_mm": -700}
    for count in (0, 10_001):
        answer = service.client.post(f"{worn}/solve", json={"targets": [place] * count})
        assert problem_of(answer, 422)["field"] == "targets"


def test_a_temperature_counts_where_growth_was_learned_by_it(service: Service) -> None:
    machine = Drawn(WARM, seed=3)
    sequence, fresh = (with_temperature(machine.sequence()), with_temperature(machine.fresh()))
    where = imported(service, sequence, fresh)

    def command(**more: float) -> tuple[float, float]:
        body = {"targets": [{"x_mm": 100, "y_mm": -660, **more}]}
        (found,) = service.client.post(f"{where}/solve", json=body).json()["commands"]
        return found["theta1_deg"], found["theta2_deg"]

    assert command(temperature_c=20.0) == pytest.approx(command(), abs=1e-3)
    assert abs(command(temperature_c=28.0)[0] - command()[0]) > 1e-3


def with_temperature(measurements: Any) -> str:
    header, *rows = to_csv(measurements).splitlines()
    t = measurements.temperature_c
    return "\n".join([f"{header},temperature_c", *(f"{r},{v:.3f}" for r, v in zip(rows, t, strict=True)), ""])


def test_a_run_without_a_diagnosis_has_no_model_to_solve_with(service: Service) -> None:
    body = {"targets": [{"x_mm": 0, "y_mm": -700}]}
    run = service.complete()
    assert (
        "has no diagnosis" in problem_of(service.client.post(f"{LIST}/{run}/solve", json=body), 404)["detail"]
    )
    problem_of(service.client.post(f"{LIST}/99/solve", json=body), 404)
