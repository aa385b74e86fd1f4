"""A study gives the same figures on one core and on many, and goes on from where it was ended."""

from __future__ import annotations

from pathlib import Path

import pytest
from rich.console import Console

from station.studies.engine import CHUNK, FEW, Engine, digest

QUIET = Console(quiet=True)


def square(n: int) -> int:
    return n * n


def refuse(n: int) -> int:
    if n >= 3 * CHUNK:
        raise RuntimeError("ended")
    return n * n


def test_order_and_figures_do_not_depend_on_the_number_of_workers() -> None:
    items = list(range(FEW + 5))
    one, two = (Engine(QUIET, workers).each(square, items, "Squares") for workers in (1, 2))
    assert one == two == [n * n for n in items]
    assert digest(one) == digest(two)


def test_an_ended_study_goes_on_from_what_was_done(tmp_path: Path) -> None:
    items = list(range(5 * CHUNK))
    with pytest.raises(RuntimeError, match="ended"):
        Engine(QUIET, 1, tmp_path).each(refuse, items, "Squares")
    assert len(list(tmp_path.glob("*.pickle"))) == 3

    def only_the_rest(n: int) -> int:
        assert n >= 3 * CHUNK, "done before"
        return n * n

    assert Engine(QUIET, 1, tmp_path).each(only_the_rest, items, "Squares") == [n * n for n in items]


def test_another_study_takes_nothing_of_the_first(tmp_path: Path) -> None:
    Engine(QUIET, 1, tmp_path).each(square, [1, 2], "Squares")
    assert Engine(QUIET, 1, tmp_path).each(lambda n: -n, [1, 2], "Negatives") == [-1, -2]


def test_a_digest_is_of_the_content_not_of_the_order_of_keys() -> None:
    assert digest({"a": 1, "b": [2.5]}) == digest({"b": [2.5], "a": 1}) != digest({"a": 1, "b": [2.6]})
