"""The uncertainty of a reading, contribution by contribution, against numbers worked out by hand."""

from __future__ import annotations

from datetime import date

import pytest

from station.certificate.budget import reading_budget
from station.records import Reading, ScaleCertificate

SCALE = ScaleCertificate(
    scale="SN 1",
    certificate="C 1",
    laboratory="L",
    calibrated=date(2026, 1, 1),
    due=date(2027, 1, 1),
    u95_um=1.0,
    u95_um_per_m=4.0,
    expansion_ppm_per_k=10.0,
    temperature_c=23.0,
    temperature_within_k=2.0,
)


def reading(number: int, mean_mm: float, spread_mm: float, temperature_c: float | None = None) -> Reading:
    samples = (mean_mm - spread_mm, mean_mm, mean_mm + spread_mm)
    return Reading(
        number, 0.0, (0.0, 180.0), (1, 1), mean_mm, f"p{number}", 1, samples, temperature_c=temperature_c
    )


def test_each_contribution_is_as_worked_out_by_hand() -> None:
    found = reading_budget([reading(1, 10.0, 0.005), reading(2, 260.0, 0.01)], SCALE)
    standard = {one.source: one.standard_um for one in found}
    # samples of 5 and 10 um to either side: pooled sqrt((50 + 200) / 4) um, over the root of three
    assert standard["repeatability"] == pytest.approx((250 / 4) ** 0.5 / 3**0.5)
    assert standard["resolution"] == pytest.approx(5 / 12**0.5)
    assert standard["scale_calibration"] == pytest.approx((1 + 4 * 0.25) / 2)
    assert standard["scale_temperature"] == pytest.approx(10 * 0.25 * 2 / 3**0.5)
    assert standard["temperature_correction"] == pytest.approx(10 * 0.25 * 3)


def test_a_measured_temperature_counts_for_more_than_the_stated_one() -> None:
    found = reading_budget([reading(1, 0.0, 0.001, 20.0), reading(2, 100.0, 0.001, 22.0)], SCALE)
    correction = found[-1]
    assert (correction.source, correction.detail["at_c"]) == ("temperature_correction", 21.0)
    assert correction.standard_um == pytest.approx(10 * 0.1 * 1)


def test_without_a_certificate_only_what_the_readings_show_is_stated() -> None:
    assert [one.source for one in reading_budget([reading(1, 1.0, 0.002)], None)] == [
        "repeatability",
        "resolution",
    ]
    assert reading_budget([], SCALE) == ()
