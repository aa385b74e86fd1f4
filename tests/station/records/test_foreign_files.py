"""One log in many ways of writing it: each must come out as the same readings, by its own proposal."""

from __future__ import annotations

import io
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from openpyxl import Workbook

from station.errors import InputRefused
from station.records import (
    ColumnMap,
    Columns,
    Measurements,
    Real,
    parse_measurements,
    proposed_map,
    read_foreign,
    translated,
)
from station.records.foreign_numbers import signs_of

ARM = Columns(
    joints=3,
    distance="range_mm",
    tracker=("tracker_x_mm", "tracker_y_mm", "tracker_z_mm"),
    either=True,
    time_ordered=False,
)
RNG = np.random.default_rng(5)
ANGLES: Real = RNG.uniform(-160.0, 160.0, (9, 3)).round(4)
PLACES: Real = RNG.uniform(-1900.0, 1900.0, (9, 3)).round(4)


def comma(value: float) -> str:
    return f"{value:.4f}".replace(".", ",")


def german(value: float) -> str:
    return f"{value:,.4f}".replace(",", "T").replace(".", ",").replace("T", ".")


def text(header: str, sep: str, angle: object = str, place: object = str) -> str:
    assert callable(angle) and callable(place)
    rows = [
        sep.join([*map(angle, map(float, a)), *map(place, map(float, p))])
        for a, p in zip(ANGLES, PLACES, strict=True)
    ]
    return "\n".join([header, *rows]) + "\n"


def radians(value: float) -> str:
    return f"{np.radians(value):.9f}"


def metres(value: float) -> str:
    return f"{value / 1000.0:.9f}"


def matrices(by_row: bool) -> str:
    rows = []
    for a, p in zip(ANGLES, PLACES, strict=True):
        pose = np.eye(4)
        pose[:2, :2] = [[0.6, -0.8], [0.8, 0.6]]
        pose[:3, 3] = p
        rows.append(",".join(map(str, [*a, *(pose if by_row else pose.T).ravel()])))
    names = [f"T{i}{j}" for i in range(1, 5) for j in range(1, 5)]
    return "\n".join([",".join(["q1", "q2", "q3", *names]), *rows])


def spreadsheet() -> bytes:
    book = Workbook()
    note = book.active
    assert note is not None
    note.append(["measured by", "somebody", datetime(2026, 3, 1)])
    sheet = book.create_sheet("Messung")
    sheet.append(["Zeit", "A1", "A2", "A3", "X", "Y", "Z"])
    for k, (a, p) in enumerate(zip(ANGLES, PLACES, strict=True)):
        sheet.append(
            [datetime(2026, 3, 1) + timedelta(seconds=3 * k + k % 2), *map(float, a), *map(float, p)]
        )
    out = io.BytesIO()
    book.save(out)
    return out.getvalue()


FILES: dict[str, bytes] = {
    "semicolons, decimal commas, UTF-16": text(
        "Achse1;Achse2;Achse3;X_ist;Y_ist;Z_ist", ";", comma, comma
    ).encode("utf-16"),
    "a page of notes, thousands points, Windows-1252": (
        "Messprotokoll;;;;;\nDatum;12.03.2024;;;;\n\n"
        + text("Achse 1 [°];Achse 2 [°];Achse 3 [°];X gemessen;Y gemessen;Z gemessen", ";", german, german)
    ).encode("cp1252"),
    "tabs and a byte-order mark": text("J1\tJ2\tJ3\tx\ty\tz", "\t").encode("utf-8-sig"),
    "blanks, no header, radians and metres": text("", "   ", radians, metres).encode(),
    "comment signs": (
        "% log\n" + text("% q1 q2 q3 px py pz", " ", "{:.9e}".format, "{:.9e}".format)
    ).encode(),
    "thousands commas in quotes": text("axis1,axis2,axis3,X,Y,Z", ",", str, lambda v: f'"{v:,.4f}"').encode(),
    "a row of units": (
        "j1,j2,j3,x,y,z\n[rad],[rad],[rad],[m],[m],[m]" + text("", ",", radians, metres)
    ).encode(),
    "inches in the name": text(
        "q1 (deg),q2 (deg),q3 (deg),x (in),y (in),z (in)", ",", str, lambda v: f"{v / 25.4:.9f}"
    ).encode(),
    "a pose matrix by rows": matrices(by_row=True).encode(),
    "a pose matrix by columns": matrices(by_row=False).encode(),
    "Chinese in GB 18030": text("关节1,关节2,关节3,实测X,实测Y,实测Z", ",").encode("gb18030"),
    "narrow blanks group digits": text(
        "Axe 1 (°);Axe 2 (°);Axe 3 (°);X mesuré (mm);Y mesuré (mm);Z mesuré (mm)",
        ";",
        comma,
        lambda v: f"{v:,.4f}".replace(",", "\u202f").replace(".", ","),
    ).encode(),
    "a separator too many": text("q1;q2;q3;x;y;z;", ";").replace("\n", ";\n").replace(";;", ";").encode(),
    "the second sheet of a spreadsheet": spreadsheet(),
}


def read(content: bytes, name: str = "log", more: str = "") -> Measurements:
    given = ColumnMap.parse((proposed_map(read_foreign(content, name)) + more).encode())
    return parse_measurements(translated(content, given, ARM, name).content, ARM, source=name)


@pytest.mark.parametrize("content", FILES.values(), ids=FILES.keys())
def test_every_way_to_write_a_log_gives_the_same_readings(content: bytes) -> None:
    m = read(content)
    assert np.degrees(m.theta) == pytest.approx(ANGLES, abs=1e-4)
    assert m.tracker == pytest.approx(PLACES, abs=1e-4)


def test_a_column_that_an_export_repeats_is_taken_once() -> None:
    rows = [f"{k};0,{k}1;0,{k}2;0,{k}3;{k},5;{k},6;{k},7;0,{k}1" for k in range(1, 9)]
    table = read_foreign("\n".join(["Nr;q1;q2;q3;x;y;z;q1", *rows]).encode(), "twice.csv")
    assert table.header == ("Nr", "q1", "q2", "q3", "x", "y", "z")
    other = [row[:-1] + "9" for row in rows]
    assert read_foreign("\n".join(["Nr;q1;q2;q3;x;y;z;q1", *other]).encode(), "twice.csv").header[-1] == "q1"


def test_metres_are_recognised_far_from_the_instrument() -> None:
    rows = [f"{k},0.{k}1,0.{k}2,0.{k}3,-16.{k},7.{k},28.{k}" for k in range(1, 9)]
    table = read_foreign("\n".join(["seq,q1,q2,q3,x,y,z", *rows]).encode(), "far.csv")
    assert 'tracker_mm = {columns = ["x", "y", "z"], unit = "m"}' in proposed_map(table)
    # in mm the same place differs by more than any arm in metres does
    rows = [f"{k},0.{k}1,0.{k}2,0.{k}3,-16{k},7{k},28{k}" for k in range(1, 9)]
    table = read_foreign("\n".join(["seq,q1,q2,q3,x,y,z", *rows]).encode(), "near.csv")
    assert 'tracker_mm = {columns = ["x", "y", "z"], unit = "mm"}' in proposed_map(table)


def test_a_spreadsheet_says_when() -> None:
    assert read(spreadsheet()).t_s == pytest.approx([3 * k + k % 2 for k in range(9)])


def test_measured_columns_are_taken_before_commanded_ones_and_joints_in_the_order_of_the_arm() -> None:
    header = (
        "stamp elbow_joint shoulder_lift_joint shoulder_pan_joint wrist_1_joint wrist_2_joint wrist_3_joint"
    )
    row = " ".join(["2026-03-01T10:00:0{k}", *["0.{k}"] * 6, *["1.{k}"] * 6])
    table = read_foreign(
        "\n".join(
            [f"{header} goal_x goal_y goal_z actual_x actual_y actual_z"]
            + [row.replace("{k}", str(k)) for k in range(1, 8)]
        ).encode(),
        "ros.txt",
    )
    proposal = proposed_map(table)
    assert '"shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint"' in proposal
    assert 'tracker_mm = {columns = ["actual_x", "actual_y", "actual_z"], unit = "m"}' in proposal
    assert 't_s = "stamp"' in proposal


def test_several_points_of_a_row_become_a_reading_each() -> None:
    rows = [",".join(map(str, [*a, *p, *(p + 7.0)])) for a, p in zip(ANGLES, PLACES, strict=True)]
    m = read("\n".join(["q1,q2,q3,x1,y1,z1,x2,y2,z2", *rows]).encode())
    assert (len(m), m.mounts, m.ids[:3]) == (18, ("1", "2"), ("1/1", "1/2", "2/1"))
    assert m.tracker is not None
    assert m.tracker[1::2] - m.tracker[::2] == pytest.approx(np.full((9, 3), 7.0))


def test_readings_without_a_position_are_left_out_whatever_stands_there() -> None:
    lines = text("q1,q2,q3,x,y,z", ",").splitlines()
    for line, said in ((3, ",,"), (5, "NaN,NaN,NaN"), (7, "0.0,0,0.00")):
        lines[line] = ",".join([*lines[line].split(",")[:3], said])
    content = "\n".join(lines).encode()
    found = translated(
        content, ColumnMap.parse(proposed_map(read_foreign(content, "log")).encode()), ARM, "log"
    )
    assert found.lost == 3
    assert parse_measurements(found.content, ARM).ids == (1, 2, 4, 6, 8, 9)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "no rows of numbers"),
        (b"words\nand more words\n", "no rows of numbers"),
        (b"q1,q2\n", "no rows of numbers"),
        (b"MATLAB 5.0\0\1\2", "neither a text file nor an .xlsx file"),
        (b"PK\x03\x04 no zip", "not a spreadsheet that can be read"),
        (b"\xd0\xcf\x11\xe0 old", "save it as .xlsx"),
        (b"a,b,c\n1,2,3\n1,2,3\n1,2\n", "row 4 has 2 fields where the others have 3"),
        (b'a;b\n1;2\n1;"2\n' + b"x" * 200_000, "is not a table: field larger than field limit"),
    ],
    ids=["empty", "words", "header", "binary", "no zip", "old", "truncated", "quotes"],
)
def test_what_is_no_table_is_refused_in_a_sentence(content: bytes, said: str) -> None:
    with pytest.raises(InputRefused, match=said):
        read_foreign(content, "log")


def test_a_refusal_names_the_line_of_the_file() -> None:
    lines = ["note", "", *text("q1,q2,q3,x,y,z", ",").splitlines()]
    lines[6] = "," + lines[6].partition(",")[2]
    with pytest.raises(InputRefused, match="log: row 7, column theta1_deg: is empty"):
        read("\n".join(lines).encode())


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("pose = [1, 2, 3]\n", "needs a list of the 12 or 16 columns"),
        ('theta1_deg = {column = "q1", unit = "grain"}\n', r"\[columns.theta1_deg"),
        ('t_s = "words"\n', "is neither a number nor a time"),
    ],
)
def test_a_wrong_line_of_the_map_is_named(more: str, said: str) -> None:
    content = (
        text("q1,q2,q3,x,y,z,words", ",", str, str).replace("\n", ",soon\n").replace("words,soon", "words")
    )
    with pytest.raises(InputRefused, match=said):
        read(content.encode(), more=more)


def test_a_map_that_is_not_toml_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "map.toml"
    file.write_bytes(b"\xff[")
    with pytest.raises(InputRefused, match="is not valid TOML"):
        ColumnMap.read(file)


@given(
    st.lists(st.floats(-1e6, 1e6).filter(lambda v: abs(v) >= 1e-3 or v == 0.0), min_size=4),
    st.sampled_from([(".", ""), (",", ""), (".", ","), (",", "."), (".", "'"), (",", "\u00a0")]),
)
def test_numbers_come_back_however_they_are_written(values: list[float], signs: tuple[str, str]) -> None:
    decimal, thousands = signs
    written = [
        f"{value:,.5f}".replace(",", "T").replace(".", decimal).replace("T", thousands) for value in values
    ]
    found = signs_of([*written, f"1{thousands}234{decimal}5"])
    assert [float(found.plain(cell)) for cell in written] == pytest.approx(values, abs=1e-5)


def test_positions_of_joints_in_brackets_are_the_angles() -> None:
    """As a recorded topic of joint states is exported."""
    names = [f"position[{i}]" for i in range(3)] + ["pose.position.x", "pose.position.y", "pose.position.z"]
    rows = "\n".join(",".join(str(0.1 * k + 0.01 * i) for i in range(6)) for k in range(12))
    proposal = proposed_map(read_foreign((",".join(names) + "\n" + rows).encode(), "log.csv"))
    assert 'theta_deg = {columns = ["position[0]", "position[1]", "position[2]"]' in proposal
