"""Days of a simulated station: nothing that must hold is broken, and planted mistakes are found."""

from __future__ import annotations

import pytest

from station.simulation import live
from tests.station.simulation.planted import PLANTED, Planted

QUICK = {
    "readings are stored rounded": 1,
    "an interrupted run remains active": 1,
    "a stop is confirmed without asking the drives": 7,
    "starts are not in the audit": 1,
    "starts are in the audit twice": 1,
    "a run is changed after its end": 1,
}
"""Mistakes that the first days show, and a seed; `python -m tests.station.simulation.planted` plants all."""


def test_the_same_seed_lives_the_same_days() -> None:
    first, second = live(seed=2026, days=1), live(seed=2026, days=1)
    assert first.violations == ()
    assert first.runs >= 3
    assert first.digest == second.digest


@pytest.mark.parametrize("planted", [p for p in PLANTED if p.name in QUICK], ids=lambda planted: planted.name)
def test_a_planted_mistake_is_found(planted: Planted) -> None:
    assert planted.found(QUICK[planted.name]).violations
