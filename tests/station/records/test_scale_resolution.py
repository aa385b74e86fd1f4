"""The step of a readout in the noise of its readings."""

from __future__ import annotations

import numpy as np
import pytest

from station.five_bar import FiveBar, Robot
from station.records import Reading, from_readings
from station.records.scale_resolution import scale_resolution_mm


def test_the_step_is_seen_in_the_samples() -> None:
    assert scale_resolution_mm([131.46, 131.47, 120.0, -3.01]) == pytest.approx(0.01)
    assert scale_resolution_mm([131.465, 131.47]) == pytest.approx(0.005)


def test_a_fine_step_is_none_and_nothing_is_no_step() -> None:
    assert scale_resolution_mm([131.4601, 131.4604, 131.4611]) == 0.0
    assert scale_resolution_mm([]) == 0.0
    assert scale_resolution_mm([1.0, 1.0]) == 0.0


def test_no_mean_is_better_than_the_step() -> None:
    def sd_mm(step_mm: float) -> float:
        values = [100.0 + step_mm * n for n in (0, 1, 3, 4)]
        readings = [
            Reading(n, float(n), (5.0 * n, 180.0), (1, 1), value, f"p{n}", 1, (value,) * 5)
            for n, value in enumerate(values)
        ]
        return float(FiveBar(Robot.default(), from_readings(readings)).row_sd.mean())

    fine, coarse = sd_mm(0.0001), sd_mm(0.01)
    assert coarse == pytest.approx(np.hypot(fine, 0.01 / np.sqrt(12)), rel=0.02)
