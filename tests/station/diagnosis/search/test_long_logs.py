"""Thousands of rows: linear steps are the fits they stand for, and a few gross rows decide nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from station.diagnosis.search import long_log
from station.diagnosis.search.scan import INVISIBLE_SHARE, Scan
from station.diagnosis.tests_of_fit.cross_validation import without_a_quarter
from station.diagnosis.traced_loop import traced
from station.effects import signature
from station.effects.cyclic import GearCyclic
from station.effects.gear_curve import GearCurve
from station.fitting.prior import tolerance_prior
from station.machines import effects_of, mechanism_of
from station.mechanism.conditions import reference_of
from station.model.model import Fit, Model, Term, fit, is_long
from station.studies.arms.physics import UR_LIKE, random_arm, random_poses
from tests.station.serial_arm.test_closed_loop import harmonic_drive, ripple


@pytest.fixture(scope="module")
def learned() -> Fit:
    """A curve in joint 2 and a ripple in joint 4, both in the model, the curve as smooth as it begins."""
    arm = random_arm(UR_LIKE, 6, j2=harmonic_drive, j4=ripple(0.02, 11.0))
    m = arm.log(random_poses(6, 500, 6), 6)
    mechanism = mechanism_of(arm.robot, m)
    base = fit(Model(mechanism, reference_of(m)), tolerance_prior(mechanism), mechanism.row_sd)
    terms = []
    for effect in (GearCurve(2), GearCyclic(4)):
        variants = effect.variants(base.conditions)
        assert variants is not None
        hidden = {"per_rev": 11.0} if isinstance(effect, GearCyclic) else variants.hidden[0]
        terms.append(Term(effect, hidden, variants.acts, variants.basis.shape[2], variants.spread))
    model = replace(base.model, terms=tuple(terms))
    return fit(model, tolerance_prior(mechanism), mechanism.row_sd)


def close(one: Fit, other: Fit) -> bool:
    """Within a twentieth of a standard deviation in every unknown."""
    sd = np.sqrt(np.diag(other.solution.covariance))
    return bool(np.abs((one.x - other.x) / sd).max() < 0.05)


def test_readings_are_taken_out_of_a_fit_as_if_it_had_never_seen_them(learned: Fit) -> None:
    kept = np.ones(500, dtype=bool)
    kept[[3, 77, 401]] = False
    out = long_log.without(learned, kept)
    again = fit(out.model, tolerance_prior(out.model.mechanism), out.row_sd)
    assert close(out, again)
    assert out.cost == pytest.approx(again.cost, rel=1e-3)
    assert not close(learned, again)


@pytest.mark.parametrize("k", [0, 1])
def test_an_effect_is_taken_out_of_a_fit_as_if_it_had_never_been_in_it(learned: Fit, k: int) -> None:
    prior = tolerance_prior(learned.model.mechanism)
    out = long_log.less(learned, k, prior)
    assert [t.key for t in out.model.terms] == [learned.model.terms[1 - k].key]
    again = fit(out.model, prior, out.row_sd)
    assert close(out, again)
    assert out.cost == pytest.approx(again.cost, rel=1e-2)


def test_noise_and_spread_are_learned_together(learned: Fit) -> None:
    """Whatever noise was believed: here ten times too much."""
    loud = fit(learned.model, tolerance_prior(learned.model.mechanism), 10.0 * learned.row_sd)
    settled = long_log.settled(loud, tolerance_prior(learned.model.mechanism))
    assert settled.row_sd[0] == pytest.approx(0.02, rel=0.1)
    assert settled.cost / settled.dof == pytest.approx(1.0, abs=0.1)


def test_a_few_gross_distances_suggest_no_effect() -> None:
    arm = random_arm(UR_LIKE, 7, j2=harmonic_drive)
    m = arm.log(random_poses(6, 1100, 7), 7)
    distance = m.distance.copy()
    gross = [60, 61, 340, 341, 342, 900, 901]
    distance[gross] += [0.8, 0.9, -0.7, -0.8, -0.9, 0.7, 0.8]
    found = traced(arm.robot, replace(m, distance=distance, tracker=None))
    assert is_long(found.last.model.mechanism)
    assert {o.reading for o in found.outliers} == {k + 1 for k in gross}
    assert [f.term.effect.label for f in found.trace.findings] == ["gear_cyclic curve of joint 2"]


@pytest.mark.parametrize("seed", range(103, 109))
def test_generous_tolerances_make_no_cause_of_noise(seed: int) -> None:
    """Forty-two unknowns and a hundred distances, most unknowns far better than their tolerance."""
    arm = random_arm(UR_LIKE, seed)
    m = replace(arm.log(random_poses(6, 130, seed), seed), tracker=None)
    found = traced(arm.robot, *without_a_quarter(m))
    assert (found.verdict, found.confirmed) == ("adequate", True)


def test_the_scan_says_what_every_row_says(learned: Fit) -> None:
    """Sums over the rows of a reading change nothing: here against signatures row by row."""
    scan, solution = Scan(learned), learned.solution
    J, C, r = solution.jacobian, solution.covariance, -solution.residual
    compared = 0
    for effect in effects_of(learned.model.mechanism):
        variants = effect.variants(learned.conditions)
        if variants is None or variants.basis.shape[2] > 2:
            continue
        reduction, share, _ = scan.reductions(variants, variants.basis[:2])
        rows = learned.model.mechanism.reading_of_row
        for k, basis in enumerate(variants.basis[:2]):
            S = signature(variants.acts, basis, learned.at, learned.model.names, rows)
            S = S / learned.row_sd[:, None]
            left = S.T @ S - S.T @ J @ C @ J.T @ S
            if share[k] < INVISIBLE_SHARE or np.linalg.cond(left) > 1e8:
                continue
            expected = S.T @ r @ np.linalg.solve(left, S.T @ r)
            # of two columns that are nearly one, rounding leaves 1e-7 of a chi-square
            assert reduction[k] == pytest.approx(expected, rel=1e-5, abs=1e-6)
            compared += 1
    assert compared > 10
