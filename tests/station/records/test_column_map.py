"""Files made elsewhere: separators, decimal signs, units, differences, lost targets, spreadsheets."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook

from station.errors import InputRefused
from station.records import ColumnMap, Columns, parse_measurements, proposed_map, read_foreign, translated

ARM = Columns(
    joints=2,
    distance="range_mm",
    tracker=("tracker_x_mm", "tracker_y_mm", "tracker_z_mm"),
    either=True,
    time_ordered=False,
)
GERMAN = "Zeit;q1;q2;x;y;z\n" + "".join(f"spoiled;0,{k};-1,{k};1,2{k}5;0,5;-0,25\n" for k in range(1, 7))
MAP = 'decimal = ","\n[columns]\ntheta_deg = {columns = ["q1", "q2"], unit = "rad"}\n'
METRES = 'tracker_mm = {columns = ["x", "y", "z"], unit = "m"}\n'


def mapped(tmp_path: Path, text: str) -> ColumnMap:
    file = tmp_path / "map.toml"
    file.write_text(text)
    return ColumnMap.read(file)


def test_semicolons_decimal_commas_radians_and_metres(tmp_path: Path) -> None:
    found = translated(GERMAN.encode(), mapped(tmp_path, MAP + METRES), ARM, "log.csv")
    m = parse_measurements(found.content, ARM, source="log.csv")
    assert (found.lost, len(m), m.ids) == (0, 6, (1, 2, 3, 4, 5, 6))
    assert m.theta[0] == pytest.approx([0.1, -1.1])
    assert m.tracker is not None
    assert m.tracker[0] == pytest.approx([1215.0, 500.0, -250.0])
    assert np.isnan(m.distance).all()


def test_the_proposal_is_the_map_that_a_person_would_write(tmp_path: Path) -> None:
    proposal = proposed_map(read_foreign(GERMAN.encode(), "log.csv"))
    assert proposal == MAP + METRES
    assert translated(GERMAN.encode(), mapped(tmp_path, proposal), ARM, "log.csv").lost == 0


def test_target_minus_deviation_is_the_position(tmp_path: Path) -> None:
    text = "n,joint_1,joint_2,x_t,y_t,z_t,x_dif,y_dif,z_dif\n" + "".join(
        f"{k},10.{k},20.{k},100,200,300,1,2,{k}\n" for k in range(1, 7)
    )
    proposal = proposed_map(read_foreign(text.encode(), "log.csv"))
    content = translated(text.encode(), mapped(tmp_path, proposal), ARM, "log.csv").content
    tracker = parse_measurements(content, ARM).tracker
    assert tracker is not None
    assert tracker[4] == pytest.approx([99.0, 198.0, 295.0])


@pytest.mark.parametrize("missing", [None, [-1, -1, -1]])
def test_rows_of_a_lost_target_are_left_out_and_counted(tmp_path: Path, missing: list[int] | None) -> None:
    gone = "0,0,0" if missing is None else "-1,-1,-1"
    rows = [f"{k},{k}.5,30.{k},{gone if k == 3 else f'500,{k},2'}" for k in range(1, 8)]
    header = "reading,theta1_deg,theta2_deg,tracker_x_mm,tracker_y_mm,tracker_z_mm"
    text = "\n".join([header, *rows])
    given = None if missing is None else mapped(tmp_path, f"missing = {missing}\n")
    found = translated(text.encode(), given, ARM, "log.csv")
    assert found.lost == 1
    assert parse_measurements(found.content, ARM).ids == (1, 2, 4, 5, 6, 7)


def test_a_spreadsheet_and_a_file_without_a_header(tmp_path: Path) -> None:
    book = Workbook()
    sheet = book.active
    assert sheet is not None
    for k in range(1, 7):
        sheet.append([k / 10, -k / 10, 0.5, 0.25, k / 100])
    file = io.BytesIO()
    book.save(file)
    text = 'header = false\n[columns]\ntheta_deg = {columns = [1, 2], unit = "rad"}\n'
    given = mapped(tmp_path, text + 'tracker_mm = {columns = [3, 4, 5], unit = "m"}\n')
    content = translated(file.getvalue(), given, ARM, "log.xlsx").content
    m = parse_measurements(content, ARM)
    assert m.tracker is not None
    assert m.tracker[5] == pytest.approx([500.0, 250.0, 60.0])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[columns]\ntheta_deg = ["q1"]\n', "has 1 columns where 2 are needed"),
        ('[columns]\nt_s = "when"\n', "column 'when' is missing; there are Zeit, q1"),
        ('[columns]\ntheta1_deg = {column = "q1", unit = "mm"}\n', "cannot be in mm; its units: deg, rad"),
        ('[columns]\nangle = "q1"\n', "is not a column that is read"),
        ('decimal = ";"\n', r"\[decimal\]"),
    ],
)
def test_a_wrong_map_is_refused_by_place(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputRefused, match=said):
        translated(GERMAN.encode(), mapped(tmp_path, text), ARM, "log.csv")
