"""The study with few seeds: what does not depend on them to the digit, what does by its shape."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner

from station.cli import main

SEEDS = 2
BEFORE_MM = {
    "table3": (10.933, 5.482, 3.796, 10.897, 5.518, 3.798),
    "table4": (12.906, 6.418, 4.672, 12.868, 6.455, 4.663),
}


# the whole study runs once for all of them
pytestmark = [pytest.mark.long, pytest.mark.timeout(400)]


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], str]:
    """What `station reproduce` writes: JSON and page."""
    folder = tmp_path_factory.mktemp("reproduce")
    answer = CliRunner().invoke(
        main,
        [
            "reproduce",
            "--seeds",
            str(SEEDS),
            "--json",
            str(folder / "r.json"),
            "--html",
            str(folder / "r.html"),
        ],
        catch_exceptions=False,
    )
    assert answer.exit_code == 0, answer.output
    return json.loads((folder / "r.json").read_text()), (folder / "r.html").read_text()


@pytest.fixture
def content(written: tuple[dict[str, Any], str]) -> dict[str, Any]:
    return written[0]


def test_condition_numbers_to_the_digit_with_the_sign_of_f(content: dict[str, Any]) -> None:
    assert (round(content["kappa_1"], 2), round(content["kappa_m"], 2)) == (475.34, 472.35)
    assert content["f"] == "lambda - dr_M"
    assert [row["n"] for row in content["fig8"]] == list(range(3, 11))


@pytest.mark.parametrize("table", BEFORE_MM)
def test_before_columns(content: dict[str, Any], table: str) -> None:
    found = [row["before_mm"] for row in content[table]]
    assert found == pytest.approx(BEFORE_MM[table], abs=2e-3)


@pytest.mark.parametrize("number", range(3, 10))
def test_every_table_has_the_print_and_both_methods_beside_it(content: dict[str, Any], number: int) -> None:
    rows = content[f"table{number}"]
    assert [row["group"] for row in rows] == list(range(1, 7 if number < 7 else 4))
    for row in rows:
        assert row["paper"]
        assert {r["noise"] for r in row["results"]} == {"scale", "scale and servo"}
        assert {r["method"] for r in row["results"]} == {"paper", "ours"} - (
            {"ours"} if number == 6 else set()
        )
        assert ("label" in row) is (number >= 7)


def test_table_3_has_the_contracts_fields(content: dict[str, Any]) -> None:
    fields = {"group", "before_mm", "after_mm", "zero_offsets_deg", "delta_deg", "paper"}
    assert fields <= set(content["table3"][0])


def test_errata_are_named_with_evidence(content: dict[str, Any]) -> None:
    where = [erratum["where"] for erratum in content["errata"]]
    assert {"Table 1", "eq. 3", "after eq. 24", "eq. 30"} <= set(where)
    for erratum in content["errata"]:
        assert set(erratum) == {"where", "printed", "found", "evidence"}
        assert all(erratum.values())
    rank = next(e for e in content["errata"] if e["where"] == "after eq. 24")
    assert "K = 13: 9, K = 30: 9, K = 90: 9" in rank["evidence"]


def test_sensitivities_at_home_by_hand(content: dict[str, Any]) -> None:
    """Fig. 5: dr is square to w_2, so its length is w_1 . dr times 825^2 / (2 * 455 * 688.186)."""
    slopes = {s["parameter"]: s["per_unit_mm"] for s in content["fig5"]}
    per_mm = 825**2 / (2 * 455 * 688.186)
    assert slopes["l1"] == pytest.approx(per_mm, rel=1e-5)
    assert slopes["dtheta1"] == pytest.approx(per_mm * 688.186 / 825 * 375 * math.radians(1.0), rel=1e-5)
    assert slopes["e1x"] == slopes["L1"] == pytest.approx(per_mm * 455 / 825, rel=1e-5)
    assert slopes["dtheta1"] > 5.0 * max(v for name, v in slopes.items() if name != "dtheta1")


def test_figures_9_and_12(content: dict[str, Any]) -> None:
    assert len(content["fig9"]) == 12
    assert all(len(row["mu_deg"]) == len(row["m"]) - 1 for row in content["fig9"])
    assert [len(row["before_mm"]) for row in content["fig12"]] == [42, 42, 42]


def test_accuracy_stands_beside_its_bound(content: dict[str, Any]) -> None:
    ours = [row for row in content["accuracy"] if row["method"] == "ours"]
    assert all(row["bound_mm"] > 0 for row in ours)
    assert {row["servo"] for row in ours} == {"exact", "whole pulses", "continuous"}
    assert {row["samples"] for row in ours} == {1, 4, 16}


def test_coverage_and_positions(content: dict[str, Any]) -> None:
    assert content["coverage"]["machines"] == 5 * SEEDS
    assert content["coverage"]["wrong_memory"]["dropped"] == 1.0
    assert [row["readings"] for row in content["positions"]] == [24, 90]


def test_the_page_needs_no_other_host(written: tuple[dict[str, Any], str]) -> None:
    page = written[1]
    assert not re.search(r"""(?:src|href)\s*=\s*["'](?!#)""", page)
    assert not re.search(r"https?://|url\(|@import", page)
    drawings = re.findall(r"<svg.*?</svg>", page, re.DOTALL)
    assert len(drawings) > 20
    for drawing in drawings:
        ElementTree.fromstring(drawing)
        assert "nan" not in drawing.lower()


def test_a_file_that_cannot_be_written_is_refused_before_the_work(tmp_path: Path) -> None:
    answer = CliRunner().invoke(main, ["reproduce", "--json", str(tmp_path / "none" / "r.json")])
    assert answer.exit_code == 2
