"""Which effect is added next: the best that readings left out support, or one that is plain behind those."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from station.diagnosis.search import cause_search
from station.diagnosis.search.cause_search import HELPFUL, PLAINLY_HELPFUL, TRIED_TOGETHER, next_effect


@dataclass(frozen=True)
class Candidate:
    """A name, and what it takes of a square of 100."""

    name: str
    reduction: float
    p_value: float = 0.0


@dataclass(frozen=True)
class Found:
    """A fit to be scanned."""

    cost: float = 100.0
    model: Any = None


WAVES = [Candidate(f"wave {k}", 50.0) for k in range(TRIED_TOGETHER)]
CURVE = Candidate("curve", 40.0)


def tried(monkeypatch: pytest.MonkeyPatch, candidates: list[Candidate]) -> tuple[Any, list[Any]]:
    """What is chosen if only the curve helps, and what was tried with which limit."""
    asked: list[Any] = []

    def add(_scan: Any, _refitted: Any, some: list[Candidate], _hopeful: float, by: float = HELPFUL) -> Any:
        asked.append(([c.name for c in some], by))
        return next((c for c in some if c.name == "curve"), None)

    class Scan:
        def __init__(self, found: Found) -> None: ...

        def candidates(self, _effects: Any) -> list[Candidate]:
            return candidates

    monkeypatch.setattr(cause_search, "Scan", Scan)
    monkeypatch.setattr(cause_search, "_add", add)
    monkeypatch.setattr(cause_search, "_others", lambda effects, terms: effects)

    class Model:
        terms = ()

    chosen = next_effect(Found(model=Model()), lambda *_: None, [1], 0.01, 0.0)  # type: ignore[arg-type, list-item]
    return chosen, asked


def test_a_curve_behind_waves_that_do_not_help_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    chosen, asked = tried(monkeypatch, [*WAVES, CURVE])
    assert chosen == CURVE
    assert [by for _, by in asked] == [HELPFUL, PLAINLY_HELPFUL]


def test_what_is_not_worth_it_is_not_tried_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    chance, little = Candidate("curve", 40.0, p_value=0.5), Candidate("curve", 1.0)
    chosen, asked = tried(monkeypatch, [*WAVES, chance, little])
    assert chosen is None
    assert asked[1][0] == []


def test_where_the_best_helps_nothing_else_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    chosen, asked = tried(monkeypatch, [CURVE, *WAVES, CURVE])
    assert chosen == CURVE and len(asked) == 1
