"""Means and variances of a mixture."""

from __future__ import annotations

import numpy as np

from station.diagnosis.explanations.mixture import spread


def test_variance_of_a_mixture_is_mean_variance_and_variance_of_means() -> None:
    means = [np.array([1.0, 0.0]), np.array([3.0, 0.0])]
    covariances = [np.diag([0.25, 1.0]), np.diag([0.75, 1.0])]
    found = spread(means, covariances, np.array([0.5, 0.5]))
    assert np.allclose(found, np.diag([0.5 + 1.0, 1.0]))


def test_it_is_that_of_draws() -> None:
    rng = np.random.default_rng(1)
    weight = np.array([0.7, 0.2, 0.1])
    means = [rng.standard_normal(3) for _ in weight]
    roots = [rng.standard_normal((3, 3)) for _ in weight]
    which = rng.choice(3, 200_000, p=weight)
    drawn = np.array(means)[which] + np.einsum(
        "kij,kj->ki", np.array(roots)[which], rng.standard_normal((200_000, 3))
    )
    expected = np.cov(drawn.T)
    assert np.allclose(spread(means, [r @ r.T for r in roots], weight), expected, atol=0.1)
