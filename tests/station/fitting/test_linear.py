"""Systems that rounding has made singular or indefinite."""

from __future__ import annotations

import numpy as np
import pytest

from station.fitting import positive, solved


def test_a_regular_system_is_solved_as_it_stands() -> None:
    matrix = np.array([[2.0, 1.0], [1.0, 3.0]])
    assert matrix @ solved(matrix, np.array([3.0, 5.0])) == pytest.approx([3.0, 5.0])
    assert positive(matrix) is matrix


def test_a_singular_system_has_the_shortest_solution() -> None:
    assert solved(np.ones((2, 2)), np.array([2.0, 2.0])) == pytest.approx([1.0, 1.0])


def test_information_that_rounding_made_negative_becomes_positive_definite() -> None:
    """A difference of equal numbers may be -1e-9 instead of 0; units of the two unknowns differ by 1e6."""
    information = np.array([[1e12, 0.0], [0.0, -1e-9]])
    nearest = positive(information)
    np.linalg.cholesky(nearest)
    assert nearest[0, 0] == pytest.approx(1e12)
