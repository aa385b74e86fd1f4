"""Files of taught positions: dialects of CSV, and programs of controllers, read and written again."""

from __future__ import annotations

import pytest

from station.errors import InputRefused
from station.records import TranslatedPosition, read_taught_file

RIGHT = [("pick", 10.5, 170.25), ("place", -8.0, 181.5)]
KRL = """\
DEFDAT taught
;FOLD DECL E6AXIS OLD={A1 1.0,A2 2.0}
DECL E6AXIS XPICK={A1 10.5,A2 170.25,A3 0.0,A4 0.0,A5 0.0,A6 0.0,E1 0.0}
E6POS XP2={X 1.0,Y 2.0,Z 3.0,A 10.0,B 20.0,C 30.0}
XPLACE={E6AXIS: A2 1.815E2, A1 -8}
PTP {A1 0.5, A2 180.0}
PTP_REL {A1 5.0, A2 6.0}
ENDDAT
"""
RAPID = """\
MODULE taught
  ! CONST jointtarget old := [[1,2,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget pick := [[10.5,170.25,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2 := [[600,500,225.3],[1,0,0,0],[1,1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS jointtarget place:=[ [ -8, 181.5, 0, 0, 0, 0 ], [9E9,9E9,9E9,9E9,9E9,9E9]];
  MoveAbsJ [[0.5,180,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs, v1000, z50, tool1;
ENDMODULE
"""


def read(text: str) -> list[tuple[str, float, float]]:
    positions, _ = read_taught_file(text, "t")
    return [(p.position, p.theta1_deg, p.theta2_deg) for p in positions]


@pytest.mark.parametrize(
    "text",
    [
        "position,theta1_deg,theta2_deg\npick,10.5,170.25\nplace,-8,181.5\n",
        "theta2_deg,note,position,theta1_deg\n170.25,x,pick,10.5\n181.5,,place,-8\n",
        "position;theta1_deg;theta2_deg\r\npick;10,5;170,25\r\n\r\nplace;-8;181,5\r\n",
        "\ufeffPosition; Theta1_deg ;theta2_deg\npick;10.5;170.25\nplace;-8,0;1.815e2\n",
        "position\ttheta1_deg\ttheta2_deg\npick\t10,5\t170,25\nplace\t-8\t181,5\n",
    ],
)
def test_columns_may_be_in_any_order_and_separated_as_spreadsheets_do(text: str) -> None:
    assert read(text) == RIGHT


def test_radians_are_read_by_the_name_of_their_column() -> None:
    [(_, first, second)] = read("position,theta1_rad,theta2_deg\npick,0.5,170\n")
    assert (round(first, 9), second) == (28.647889757, 170.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("position,theta1_deg,theta1_rad,theta2_deg\nA,1,1,2\n", "column theta1_deg is given twice"),
        ("position,theta1_deg,theta2_deg\nA,1\n", "row 1: column theta2_deg needs a number"),
        ("position;theta1_deg;theta2_deg\nA;1,5,2;3\n", "row 1: column theta1_deg needs a number"),
        ("position,theta1_rad,theta2_rad\nA,1,inf\n", "row 1: column theta2_rad needs a number"),
        ("DECL E6AXIS P={A1 1.0,A3 2.0}\n", "line 1: P has no angle of axis 2"),
        ("\nCONST jointtarget p := [[1,9E9,0,0,0,0],[]];", "line 2: p has no angle of axis 2"),
        ("CONST jointtarget p := [[1],[]];", "line 1: p has no angle of axis 2"),
        ("", "column position is missing"),
    ],
)
def test_what_cannot_be_read_is_refused_with_its_place(text: str, words: str) -> None:
    with pytest.raises(InputRefused, match=words):
        read(text)


@pytest.mark.parametrize(("text", "names"), [(KRL, ["XPICK", "XPLACE"]), (RAPID, ["pick", "place"])])
def test_joint_targets_of_a_program_are_found(text: str, names: list[str]) -> None:
    found = read(text)
    assert [name for name, *_ in found] == [*names, "line 6"]
    assert [angles for _, *angles in found] == [[10.5, 170.25], [-8.0, 181.5], [0.5, 180.0]]


@pytest.mark.parametrize("text", [KRL, RAPID])
def test_a_program_is_written_again_with_other_angles_only(text: str) -> None:
    positions, program = read_taught_file(text, "t")
    assert program
    moved = [
        TranslatedPosition(
            position=p.position,
            theta1_deg=p.theta1_deg + 1.0,
            theta2_deg=p.theta2_deg - 0.25,
            u95_mm=None,
            within_limits=True,
        )
        for p in positions
    ]
    expected = text
    for old, new in [
        ("10.5", "11.500000"), ("170.25", "170.000000"), ("1.815E2", "181.250000"), ("-8", "-7.000000"),
        ("181.5", "181.250000"), ("0.5,180,", "1.500000,179.750000,"),
        ("A1 0.5, A2 180.0", "A1 1.500000, A2 179.750000"),
    ]:  # fmt: skip
        expected = expected.replace(old, new)
    assert program.rewritten(moved) == expected
