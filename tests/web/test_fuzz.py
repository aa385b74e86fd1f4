"""A sample of `python -m tests.web.fuzz`: one request of each operation, as a MES."""

from __future__ import annotations

from tests.web.fuzz import fuzz


def test_a_mes_breaks_nothing_and_gains_nothing() -> None:
    assert fuzz("mes", 1, 1).wrong == {}
