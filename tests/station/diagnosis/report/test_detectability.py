"""Smallest visible sizes: the checked ones of the method, and that the power is what it says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.report.detectability import POWER, detectable
from station.diagnosis.search.cause_search import SIGNIFICANT
from station.diagnosis.search.scan import Scan
from station.diagnosis.traced_loop import traced
from station.effects import five_bar_catalogue, signature
from station.effects.backlash import Backlash
from station.fitting.least_squares import Prior
from station.model.model import Fit, fit
from tests.station.simulated import ROBOT, Drawn

ARCSEC = 3600.0
CHECKED_NOISE_MM = 4e-3


@pytest.fixture(scope="module")
def clean() -> Fit:
    return traced(ROBOT, Drawn(seed=8).sequence()).last


def test_sizes_agree_with_the_checked_ones(clean: Fit) -> None:
    """Method.md, section 3: 120 readings at 4 um, four unknowns and the reading offset, e, L, l exact."""
    names = clean.model.names
    sd = np.array([1e-6 if name[0] in "eLl" else np.inf for name in names])
    sd[[names.index("dtheta1"), names.index("dtheta2")]] = np.inf
    prior = Prior.independent(clean.prior.mean, sd)
    four = fit(clean.model, prior, np.full(len(clean.row_sd), CHECKED_NOISE_MM))
    found = {(d.effect, d.joint, d.parameter): d for d in detectable(four, five_bar_catalogue())}

    def size(effect: str, joint: int | None, parameter: str, unit: str) -> float:
        entry = found[effect, joint, parameter]
        assert entry.unit == unit
        assert entry.minimum_detectable is not None
        return entry.minimum_detectable

    def near(value: float, checked: float) -> bool:
        return 1.0 / 1.5 < value / checked < 1.5

    # the page counts half the play
    assert near(size("backlash", 1, "width_deg", "deg") * ARCSEC / 2.0, 1.8)
    assert near(size("gear_cyclic", 1, "amplitude_deg", "deg") * ARCSEC, 2.4)
    for joint in (1, 2):
        assert near(size("encoder_eccentricity", joint, "amplitude_deg", "deg") * ARCSEC, 62.0)
    assert near(size("scale_gain", None, "ppm", "ppm"), 180.0)
    assert near(size("link_length", 1, "L1", "mm"), 0.10)


def test_power_is_what_it_says(clean: Fit) -> None:
    """Backlash of the smallest visible size, in 200 sequences: found in four of five."""
    effect = Backlash(1)
    entry = next(d for d in detectable(clean, five_bar_catalogue()) if (d.effect, d.joint) == ("backlash", 1))
    assert entry.minimum_detectable is not None
    variants = effect.variants(clean.conditions)
    assert variants is not None
    rows = clean.model.mechanism.reading_of_row
    column = signature(variants.acts, variants.basis[0], clean.at, clean.model.names, rows)[:, 0]
    added = column * np.radians(entry.minimum_detectable) / 2.0 / clean.row_sd
    rng = np.random.default_rng(1)
    J, C = clean.solution.jacobian, clean.solution.covariance
    times = 200
    seen = 0
    for _ in range(times):
        whitened = added + rng.normal(size=len(added))
        residual = whitened - J @ (C @ (J.T @ whitened))
        cost = float(whitened @ residual)
        one = replace(clean, solution=replace(clean.solution, residual=-residual, cost=cost))
        (candidate,) = Scan(one).candidates([effect])
        seen += candidate.p_value * len(five_bar_catalogue()) < SIGNIFICANT
    assert seen / times == pytest.approx(POWER, abs=0.1)


def test_more_noise_hides_more(clean: Fit) -> None:
    loud = replace(clean, row_sd=clean.row_sd * 3.0)
    loud = fit(clean.model, clean.prior, loud.row_sd)
    for quiet, noisy in zip(
        detectable(clean, five_bar_catalogue()), detectable(loud, five_bar_catalogue()), strict=True
    ):
        if quiet.minimum_detectable is not None and noisy.minimum_detectable is not None:
            assert noisy.minimum_detectable > 1.1 * quiet.minimum_detectable


def test_what_was_found_is_not_listed() -> None:
    sequence = Drawn({"kind": "backlash", "joint": 1, "width_deg": 0.01}, seed=1).sequence()
    listed = [(d.effect, d.joint) for d in detectable(traced(ROBOT, sequence).last, five_bar_catalogue())]
    assert ("backlash", 1) not in listed
    assert ("backlash", 2) in listed


def test_without_approach_backlash_cannot_be_shown() -> None:
    sequence = Drawn(seed=8).sequence()
    sequence.approach[:] = 0
    for entry in detectable(traced(ROBOT, sequence).last, five_bar_catalogue()):
        if entry.effect == "backlash":
            assert entry.minimum_detectable is None
            assert "not taken in a way" in entry.text


def test_labels_name_one_effect_each() -> None:
    labels = [effect.label for effect in five_bar_catalogue()]
    assert len(set(labels)) == len(labels)
