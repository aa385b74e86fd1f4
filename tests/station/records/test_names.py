"""Serials and names that cannot be a path, a formula or another's look-alike."""

from __future__ import annotations

import pytest

from station.errors import InputRefused
from station.records import account_key, checked_account, checked_name, checked_serial, harmless, one_line


@pytest.mark.parametrize(
    "serial", ["FB-1", "unnamed", "line/7.b", "Gr\u00f6\u00dfe_2", "\u0411\u0416-1", "0"]
)
def test_plain_serials_are_taken(serial: str) -> None:
    assert checked_serial(serial) == serial


@pytest.mark.parametrize(
    ("serial", "what"),
    [
        ("", "0 characters"),
        ("x" * 65, "65 characters"),
        ("..", "dots alone"),
        ("a/../b", "dots alone"),
        ("/etc", "a part of nothing"),
        ("a//b", "a part of nothing"),
        ("\uff26\uff22\uff0d1", "'\uff0d'"),
        ("\uff26\uff22-1", "full-width"),
        ("F\u0412-1", "Cyrillic and Latin"),
        ("FB-\u0661", "digits 0 to 9"),
        ("FB 1", "' '"),
        ("FB\n1", r"'\n'"),
        ("FB\ud8001", r"'\ud800'"),
        ("=1+1", "'='"),
    ],
)
def test_other_serials_are_refused_in_one_sentence(serial: str, what: str) -> None:
    with pytest.raises(InputRefused) as refused:
        checked_serial(serial)
    text = str(refused.value)
    assert what in text and "\n" not in text and text.endswith(".")
    text.encode()


@pytest.mark.parametrize("name", ["Ada\x00", "Ada\x1b[2J", "a\nb", "\ud800", "a\u2028b", "a\x85b"])
def test_names_with_control_characters_are_refused(name: str) -> None:
    with pytest.raises(InputRefused, match="control character"):
        checked_name(name)


@pytest.mark.parametrize(
    ("name", "taken"),
    [
        ("line  4", "line 4"),
        ("\uff21\uff44\uff41", "Ada"),
        ("O\u0308do\u0308n", "\u00d6d\u00f6n"),
        ("\u674e Li", "\u674e Li"),
        ("\u0411\u043e\u0440\u0438\u0441", "\u0411\u043e\u0440\u0438\u0441"),
    ],
)
def test_names_of_accounts_have_one_form(name: str, taken: str) -> None:
    assert checked_account(name) == taken
    assert account_key(name) == account_key(taken.upper()) == account_key(taken)


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("A\u0501a", "Cyrillic and Latin"),
        ("\u0391da", "Greek and Latin"),
        ("Ad\u200ba", "invisible"),
        ("Ad\u202ea", "invisible"),
        ("\ufdfa" * 4, "72 characters"),
        (" ", "0 characters"),
    ],
)
def test_names_of_accounts_that_look_like_others_are_refused(name: str, why: str) -> None:
    with pytest.raises(InputRefused, match=why):
        checked_account(name)


def test_a_line_stays_one_line() -> None:
    assert one_line("Ada\n2026 \x1b[2J\u2028\u202e \u738b") == r"Ada\n2026 \x1b[2J\u2028\u202e" + " \u738b"


def test_names_of_people_are_taken() -> None:
    for name in ("Ada Lovelace", "J\u00fcrgen", "\u738b\u5c0f\u660e", "O'Neill-Sm\u00edth, 3rd"):
        assert checked_name(name) == name


@pytest.mark.parametrize(
    "cell",
    ["=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "\n=1", "\uff1d1+1", "\uff20A1"],
)
def test_formulas_become_text(cell: str) -> None:
    assert harmless(cell) == f"'{cell}"


@pytest.mark.parametrize("cell", ["", "A1", "-1", "+0.5", "-1e-3", "a=b", "'=1"])
def test_other_cells_stay_as_they_are(cell: str) -> None:
    assert harmless(cell) == cell
