"""Gauge studies over REST and at the terminal."""

from __future__ import annotations

import json
from io import BytesIO
from pathlib import Path

import pytest
from click.testing import CliRunner
from pypdf import PdfReader

from station.cli import main
from tests.station.run_kinds.test_gauge_study import kept
from tests.web.conftest import Service

FORMS = {"json": "application/json", "html": "text/html", "pdf": "application/pdf"}


def test_the_report_in_each_form(service: Service, tmp_path: Path) -> None:
    runs = [kept(service.runtime.store, f"R{k}", k, plan="two_mounts") for k in range(2)]
    for form, media_type in FORMS.items():
        address = f"/api/v1/calibrations/{runs[0]}/gauge-study.{form}?with={runs[1]}"
        answer = service.client.get(address)
        assert (answer.status_code, answer.headers["content-type"].split(";")[0]) == (200, media_type), form
        if form == "pdf":
            pages = PdfReader(BytesIO(answer.content)).pages
            text = " ".join(" ".join(page.extract_text() for page in pages).split())
            assert "Is the gauge fit for the purpose?" in text and "calibrations with one mounting" in text
        if form == "html":
            assert answer.headers["content-security-policy"].startswith("default-src 'none'")
            assert "R0, R1" in answer.text and "0 persons confirmed" in answer.text
    found = service.client.get(f"/api/v1/calibrations/{runs[0]}/gauge-study.json").json()
    assert found["schema"] == "station.gauge-study/1" and found["joints"][0]["against"] == "tolerance"

    files = [tmp_path / f"study.{form}" for form in FORMS]
    options = [part for file in files for part in (f"--{file.suffix[1:]}", str(file))]
    command = ["--home", str(tmp_path), "gauge-study", *map(str, runs), *options]
    said = CliRunner().invoke(main, command)
    assert said.exit_code == 0, said.output
    assert "the gauge takes" in said.output and json.loads(files[0].read_text())["runs"] == runs
    assert files[2].read_bytes().startswith(b"%PDF")


def test_what_is_no_study(service: Service) -> None:
    run = service.complete()
    address = f"/api/v1/calibrations/{run}"
    refused = service.client.get(f"{address}/gauge-study.json")
    assert (refused.status_code, "no finished gauge study" in refused.json()["detail"]) == (409, True)
    assert service.client.get("/api/v1/calibrations/99/gauge-study.pdf").status_code == 404
    resumed = service.client.post(f"{address}/resume", json={"operator": "ada"})
    assert (resumed.status_code, "is no gauge study" in resumed.json()["detail"]) == (409, True)
    study = {"operators": 2, "mountings": 2, "repeats": 2}
    assert service.start(study=study).json()["field"] == "study"
    started = service.start(plan="gauge_study", study=study)
    assert (started.status_code, started.json()["kind"]) == (202, "gauge_study")


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["gauge-study", "1", "study.csv"], "one file, or the numbers of runs"),
        (["gauge-study", "study.csv", "--pdf", "x.pdf"], "there is none for a file"),
        (["calibrate", "--study", "3x2"], "three numbers from 2 to 10"),
        (["calibrate", "--study", "3x2x2"], "--plan gauge_study"),
    ],
)
def test_what_the_terminal_refuses(arguments: list[str], text: str) -> None:
    said = CliRunner().invoke(main, arguments)
    assert said.exit_code == 2 and text in " ".join(said.output.split()), said.output
