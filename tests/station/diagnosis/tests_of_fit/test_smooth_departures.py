"""Directed tests and nameless alternatives: silent on noise, loud on what they are made for."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy import stats

from station.diagnosis.search.dependence import hints
from station.diagnosis.tests_of_fit.alternatives import alternatives
from station.diagnosis.tests_of_fit.smooth_departures import WhitenedResidual, departures, of_fit
from station.diagnosis.traced_loop import TracedDiagnosis, traced
from station.effects.backlash import Backlash
from station.model.model import Fit
from station.studies.confusion.kinds import OUTSIDE
from station.studies.confusion.machines import draw
from tests.station.simulated import ROBOT, Drawn

pytestmark = pytest.mark.long

TIMES = 200


@cache
def clean() -> Fit:
    return traced(ROBOT, Drawn(seed=8).sequence()).last


def with_residual(mm: np.ndarray) -> WhitenedResidual:
    """The clean walk's fit as if it had left this residual (K,), mm."""
    fit = clean()
    part = replace(of_fit(fit, fit.row_sd), residual_mm=mm)
    return WhitenedResidual((part,), fit.prior, fit.prior.mean)


def test_p_values_of_noise_are_uniform() -> None:
    """Null hypothesis: the residual is white noise; a level of 5 % is then passed by 95 %."""
    rng = np.random.default_rng(1)
    sd = clean().row_sd
    found = [departures(with_residual(rng.normal(size=len(sd)) * sd)) for _ in range(TIMES)]
    for kind in zip(*found, strict=True):
        below = sum(d.p_value < 0.05 for d in kind)
        assert stats.binomtest(below, TIMES, 0.05).pvalue > 1e-3, kind[0].on


def test_noise_gives_no_hint() -> None:
    """Null hypothesis: the residual is white noise; some hint is then given once in a hundred."""
    rng = np.random.default_rng(2)
    sd = clean().row_sd
    hinted = sum(bool(hints(with_residual(rng.normal(size=len(sd)) * sd))) for _ in range(TIMES))
    assert stats.binomtest(hinted, TIMES, 0.01, alternative="greater").pvalue > 1e-3


@pytest.mark.parametrize(
    ("along", "per", "says"),
    [
        ("theta1", 23.0, r"about 2[23](\.\d)? times a turn"),
        ("travel", 2.0 * np.pi / 3.0, r"about every (2.9|3|3.0)\d? mm"),
    ],
)
def test_a_period_is_named(along: str, per: float, says: str) -> None:
    c = clean().conditions
    x = c.travel if along == "travel" else c.theta[:, 0]
    noise = np.random.default_rng(3).normal(size=len(x)) * clean().row_sd
    strongest = hints(with_residual(noise + 4e-3 * np.sin(per * x)))[0]
    assert strongest.depends_on == along
    assert re.search(says, strongest.said.text())


def test_temperature_is_named_where_it_is_recorded() -> None:
    fit = clean()
    rise = np.random.default_rng(4).permutation(np.linspace(0.0, 5.0, len(fit.row_sd)))
    part = replace(
        of_fit(fit, fit.row_sd),
        residual_mm=1e-3 * rise,
        conditions=replace(fit.conditions, temperature_rise=rise),
    )
    strongest = hints(WhitenedResidual((part,), fit.prior, fit.prior.mean))[0]
    assert strongest.depends_on == "temperature"


def outside(kind: str, seed: int) -> TracedDiagnosis:
    drawn = draw(ROBOT, (kind,), seed)
    return traced(ROBOT, drawn.sequence, drawn.fresh)


@pytest.mark.parametrize(
    "kind", ["cable_drag", "slider_drag", "sticky_patch", "field_bump", "wandering_zero"]
)
def test_outside_the_catalogue_of_any_size(kind: str) -> None:
    """Ten random machines, sizes from 1 um on: none confirmed; hints, if any, lead the right way."""
    found = [outside(kind, seed) for seed in range(10)]
    assert not any(d.verdict == "explained" and d.confirmed for d in found)
    first = [d.hints[0].depends_on for d in found if d.hints]
    assert len(first) >= 5
    assert first.count(OUTSIDE[kind]) >= 0.8 * len(first)


@pytest.mark.parametrize(
    ("effect", "on"),
    [
        ({"kind": "random_walk", "mm_per_stop": 0.002}, "time"),
        ({"kind": "cable_drag", "joint": 2, "deg_at_end": 0.01}, "approach x place"),
    ],
)
def test_the_best_alternative_is_the_kind_that_is_there(effect: dict[str, Any], on: str) -> None:
    machine = Drawn(effect, seed=5)
    base = traced(ROBOT, machine.sequence(), machine.fresh()).confirmations[0]
    assert min(alternatives(base.whitened), key=lambda r: r.score).on == on


def test_three_slips_are_no_better_than_a_wandering() -> None:
    """A confirmed model must beat every alternative: no small random walk is confirmed as slips or drift."""
    for seed in range(20):
        machine = Drawn({"kind": "random_walk", "mm_per_stop": 0.0006}, seed=seed)
        found = traced(ROBOT, machine.sequence(), machine.fresh())
        assert not (found.verdict == "explained" and found.confirmed)


def test_small_true_play_is_confirmed() -> None:
    """A alternative may not take away what a true cause of three times the noise explains."""
    machine = Drawn({"kind": "backlash", "joint": 1, "width_deg": 0.002}, seed=6)
    found = traced(ROBOT, machine.sequence(), machine.fresh())
    assert (found.verdict, found.confirmed) == ("explained", True)
    assert isinstance(found.trace.findings[0].term.effect, Backlash)
    assert found.confirmations[-1].alternative is None
