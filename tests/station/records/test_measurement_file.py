"""Every kind of broken file is refused in one sentence that says what, where and what to do."""

from __future__ import annotations

import csv
import io
import logging
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from station.cli.identify import identify_command
from station.errors import InputRefused
from station.five_bar.robot_file import Robot
from station.identification.estimate import identify
from station.records import Reading
from station.records.measurement_file import parse_measurements, read_measurements, readings_to_csv

HEADER = "reading,t_s,theta1_deg,theta2_deg,approach1,approach2,scale_mm,position,temperature_c"
ROWS = [
    "1,1.6,20.6352,185.8914,1,1,-42.8515,42,20.0",
    "2,3.309,-3.7242,171.2304,-1,-1,-15.6385,32,20.0",
    "3,4.652,-14.067,183.0438,-1,1,59.9777,14,20.0",
    "4,6.667,20.8008,206.6454,1,1,32.5695,27,20.0",
    "5,8.207,2.2284,218.1834,-1,1,137.7525,8,20.0",
    "6,9.905,24.7806,194.1786,1,-1,-25.466,43,20.0",
]


def text(rows: list[str] = ROWS, header: str = HEADER) -> bytes:
    return ("\n".join([header, *rows]) + "\n").encode()


def changed(row: int, column: int, value: str) -> list[str]:
    rows = list(ROWS)
    cells = rows[row].split(",")
    cells[column] = value
    rows[row] = ",".join(cells)
    return rows


def radians() -> list[str]:
    out = []
    for row in ROWS:
        cells = row.split(",")
        cells[2:4] = [f"{np.radians(float(c)):.6f}" for c in cells[2:4]]
        out.append(",".join(cells))
    return out


BROKEN = {
    "missing column": (text(header=HEADER.replace("scale_mm", "scale")), "row 1: column scale_mm is missing"),
    "NaN": (text(changed(2, 6, "nan")), "row 4, column scale_mm: nan is not a finite number"),
    "infinite": (text(changed(1, 2, "inf")), "row 3, column theta1_deg: inf is not a finite"),
    "not a number": (text(changed(1, 3, "17x")), "row 3, column theta2_deg: '17x' is not a number"),
    "empty cell": (text(changed(0, 6, "")), "row 2, column scale_mm: is empty"),
    "radians": (text(radians()), "look like radians"),
    "duplicate id": (text(changed(3, 0, "2")), "row 5, column reading: id 2 was used in row 3"),
    "empty": (b"", "is empty"),
    "blank": (b"\n \n", "is empty"),
    "header only": (text([]), "has a header and no readings"),
    "truncated": (text()[:-20], "row 7 has 5 fields where the header has 9"),
    "unreachable pose": (
        text(changed(4, 2, "178.0")),
        "Reading 5, column theta1_deg: 178.0 deg is beyond",
    ),
    "row of another pose": (
        text(changed(3, 6, "640.0")),
        "Reading 4, column scale_mm: the distance is",
    ),
    "joints exchanged": (
        text([",".join(np.array(r.split(","))[[0, 1, 3, 2, 4, 5, 6, 7, 8]]) for r in ROWS]),
        "Check unit, sign and order",
    ),
    "wrong separator": (text().replace(b",", b";"), "separated by commas"),
    "decimal comma": (
        text([r.replace(".", ",") for r in ROWS]),
        "the file is truncated or a separator is wrong",
    ),
    "binary": (bytes(range(256)) * 4, "is not a text file"),
    "latin-1": (text(header=HEADER + ",Wärme").decode().encode("latin-1"), "row 1 is not UTF-8"),
    "two rows": (text(ROWS[:2]), "only 2 readings; at least 5"),
    "one place": (
        text([",".join([str(k), str(k), *ROWS[0].split(",")[2:]]) for k in range(1, 9)]),
        "Only 1 different places",
    ),
    "row out of place": (
        text([*ROWS[:2], ROWS[4], ROWS[3], ROWS[5]]),
        "row 5, column t_s: time runs backwards",
    ),
    "bad approach": (text(changed(5, 4, "2")), "row 7, column approach1: '2' is not a direction"),
    "column twice": (text(header=HEADER.replace("position", "t_s")), "column t_s appears twice"),
    "open quote": (text(changed(5, 7, '"x')), "is not valid CSV"),
}


@pytest.mark.parametrize("kind", BROKEN)
def test_broken_files_are_refused_with_place_and_remedy(kind: str, tmp_path: Path) -> None:
    content, expected = BROKEN[kind]
    file = tmp_path / "broken.csv"
    file.write_bytes(content)
    with pytest.raises(InputRefused) as refusal:
        identify(Robot.default(), read_measurements(file))
    assert expected in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputRefused, match="cannot be read"):
        read_measurements(tmp_path / "absent.csv")


def test_unknown_columns_are_ignored_with_a_warning(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        read = parse_measurements(text([f"{r},x" for r in ROWS], HEADER + ",colour"))
    assert len(read) == 6
    assert "column colour is not known" in caplog.text


def test_what_was_written_is_read_back() -> None:
    readings = [
        Reading(k + 1, 1.5 * k, (0.1 * k, 180.0 - k), (1, -1), 10.0 + k, f"P{k}", samples_mm=(1.0, 2.0))
        for k in range(5)
    ]
    back = parse_measurements(readings_to_csv(readings).encode())
    assert back.ids == (1, 2, 3, 4, 5)
    assert np.degrees(back.theta[:, 1]) == pytest.approx([180, 179, 178, 177, 176])
    assert back.distance.tolist() == [10, 11, 12, 13, 14]
    assert back.approach[0].tolist() == [1, -1]
    assert back.temperature_c is None


def test_the_uid_of_an_export_is_read_over_in_silence(caplog: pytest.LogCaptureFixture) -> None:
    readings = [Reading(k + 1, 1.0 * k, (0.1 * k, 180.0 - k), (0, 0), 10.0, f"P{k}") for k in range(5)]
    exported = readings_to_csv(readings, run_uid="0193-uid")
    assert {row["run_uid"] for row in csv.DictReader(io.StringIO(exported))} == {"0193-uid"}
    assert len(parse_measurements(exported.encode())) == 5
    assert not caplog.records


def test_labels_that_would_be_formulas_are_written_as_text() -> None:
    labels = ("=1+1", "-1", "@A1", "P1", "+x")
    readings = [
        Reading(k + 1, 1.0 * k, (0.1 * k, 180.0 - k), (0, 0), 10.0, label, mount=label)
        for k, label in enumerate(labels)
    ]
    rows = list(csv.DictReader(io.StringIO(readings_to_csv(readings))))
    for column in ("position", "mount"):
        assert [row[column] for row in rows] == ["'=1+1", "-1", "'@A1", "P1", "'+x"]


def test_ids_may_be_words_and_quotes_are_allowed() -> None:
    rows = [r.replace(r.split(",")[0] + ",", f'"r-{i}",', 1) for i, r in enumerate(ROWS)]
    assert parse_measurements(b"\xef\xbb\xbf" + text(rows)).ids == tuple(f"r-{i}" for i in range(6))


def test_the_command_exits_2_with_one_line(tmp_path: Path) -> None:
    file = tmp_path / "two.csv"
    file.write_bytes(text(ROWS[:2]))
    outcome = CliRunner().invoke(identify_command, [str(file)])
    assert isinstance(outcome.exception, InputRefused)
