"""A month in which something did not hold is made short: what is left breaks it alone."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from station.errors import InputRefused
from station.simulation import shrunk
from station.simulation.shrinking import smallest
from tests.station.simulation.planted import PLANTED


@pytest.mark.parametrize("needed", [{3}, {0, 39}, {7, 8, 31}, {1, 4, 9, 16, 25, 36}])
def test_what_is_left_breaks_it_and_nothing_of_it_can_be_left_out(needed: set[int]) -> None:
    tried = 0

    def breaks(items: Sequence[int]) -> bool:
        nonlocal tried
        tried += 1
        return needed <= set(items)

    assert smallest(range(40), breaks) == sorted(needed)
    assert tried < 40 * len(needed)


def test_a_planted_mistake_takes_one_job_with_its_trouble() -> None:
    (planted,) = [p for p in PLANTED if p.name == "a run is changed after its end"]
    with pytest.MonkeyPatch.context() as patch:
        planted.plant(patch)
        short = shrunk(1, 1, planted.deeds, planted.troubles)
    assert short.violation.invariant == "chains"
    assert [(job.day, job.trouble) for job in short.jobs] == [(0, "none")]


def test_a_month_in_which_everything_holds_is_not_shrunk() -> None:
    with pytest.raises(InputRefused, match="nothing to shrink"):
        shrunk(1, 0)
