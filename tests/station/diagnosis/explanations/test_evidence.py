"""The evidence in closed form against scipy's normal distribution, and its bounds on signs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from station.diagnosis.explanations.evidence import Bank, Choice
from station.diagnosis.explanations.family import Family
from station.diagnosis.explanations.frame import Frame
from station.records.types import Real
from tests.station.diagnosis.explanations.problems import linearised, on_reading


class KnownNoise:
    """A noise level that is known: the logarithm of a normal density but for a constant."""

    def __call__(self, q: Real) -> Real:
        return np.asarray(-0.5 * q)

    def level(self, q: float) -> float:
        return 1.0


def narrow() -> Frame:
    """A clean sequence with priors so narrow that the dense covariance is good in double precision."""
    at, _, _ = linearised()
    noise = np.random.default_rng(3).standard_normal(len(at.row_sd))
    return replace(at, prior_sd=np.full(len(at.prior_sd), 2e-3), observed=noise)


def log_density(at: Frame, families: list[Family], sizes: list[float]) -> float:
    """Of the readings under errors of these sizes, by the dense covariance."""
    A = at.jacobian * at.prior_sd
    C = np.eye(len(at.row_sd)) + A @ A.T
    for family, size in zip(families, sizes, strict=True):
        B = at.signature(family)[0] * size
        C += B @ B.T
    return float(stats.multivariate_normal(np.zeros(len(C)), C).logpdf(at.observed))


def made(at: Frame, *widths: int) -> list[Family]:
    rng = np.random.default_rng(5)
    return [
        on_reading(f"error{k}", rng.standard_normal((len(at.row_sd), q)), (0.001, 0.004))
        for k, q in enumerate(widths)
    ]


@pytest.mark.parametrize("width", [1, 2, 3])
def test_evidence_of_one_error_is_a_ratio_of_normal_densities(width: int) -> None:
    at = narrow()
    families = made(at, width)
    bank = Bank(at, families, KnownNoise())  # type: ignore[arg-type]
    expected = log_density(at, families, [0.004]) - log_density(at, [], [])
    assert bank.log_evidence(bank.known([Choice(0, 0, 1)])) == pytest.approx(expected, abs=1e-3)


def test_members_and_sizes_are_averaged() -> None:
    at = narrow()
    families = made(at, 2)
    bank = Bank(at, families, KnownNoise())  # type: ignore[arg-type]
    base = log_density(at, [], [])
    each = [np.exp(log_density(at, families, [size]) - base) for size in (0.001, 0.004)]
    assert bank.scan(bank.known([])).total[0] == pytest.approx(np.log(np.mean(each)), abs=1e-3)


def test_a_pair_is_the_joint_evidence() -> None:
    at = narrow()
    families = made(at, 1, 2)
    bank = Bank(at, families, KnownNoise())  # type: ignore[arg-type]
    expected = log_density(at, families, [0.004, 0.001]) - log_density(at, [], [])
    pair = bank.known([Choice(0, 0, 1), Choice(1, 0, 0)])
    assert bank.log_evidence(pair) == pytest.approx(expected, abs=1e-3)
    # the second beside the first: the mean over its sizes of the joint evidence
    beside = bank.scan(bank.known([Choice(0, 0, 1)]), only=1)
    both = [bank.log_evidence(bank.known([Choice(0, 0, 1), Choice(1, 0, k)])) for k in (0, 1)]
    assert beside.total[1] == pytest.approx(np.log(np.mean(np.exp(both))), abs=1e-6)


def test_an_error_that_cannot_be_negative_gains_nothing_from_a_negative_amplitude() -> None:
    at, _, _ = linearised()
    column = np.sin(np.arange(len(at.row_sd)))[:, None]
    noisy = replace(at, observed=at.observed - 0.02 * column[:, 0] / at.row_sd)
    free = on_reading("free", column, (0.001, 0.02))
    signed = on_reading("signed", column, (0.001, 0.02), signed=True)
    turned = on_reading("turned", -column, (0.001, 0.02), signed=True)
    bank = Bank(noisy, [free, signed, turned], KnownNoise())  # type: ignore[arg-type]
    total = bank.scan(bank.known([])).total
    assert total[1] < 5.0 < total[0]
    # half of the prior is left, all of the posterior
    assert total[2] == pytest.approx(total[0] + np.log(2.0), abs=1e-6)


def test_noise_level_is_found_where_nothing_is_specified_wrongly() -> None:
    at, noise, _ = linearised()
    assert noise.level(float(at.white @ at.white)) == pytest.approx(1.0, abs=0.15)
    assert noise.level(9.0 * float(at.white @ at.white)) > 2.5
