"""Section 2 and 3: forward undoes inverse, every Jacobian agrees with differences."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.five_bar.error_model import (
    NAMES,
    distance_by_joint,
    distance_jacobian,
    perturbed,
    pose,
    position_jacobian,
)
from station.five_bar.kinematics import HOME, Unreachable, forward, inverse
from station.five_bar.robot_file import Robot

ROBOT = Robot.default()
xs = st.floats(-240.0, 240.0)
ys = st.floats(-782.0, -632.0)
deviations = st.lists(st.floats(-0.05, 0.05), min_size=12, max_size=12).map(np.array)


def test_home_position_is_where_the_paper_puts_it() -> None:
    assert forward(ROBOT.geometry, HOME[None])[0] == pytest.approx(-688.186j, abs=5e-4)


@given(xs, ys)
def test_forward_of_inverse_is_the_identity(x: float, y: float) -> None:
    r = np.array([complex(x, y)])
    assert abs(forward(ROBOT.geometry, inverse(ROBOT.geometry, r)) - r)[0] < 1e-9


@given(xs, ys, deviations)
def test_forward_of_inverse_is_the_identity_for_any_geometry(x: float, y: float, p: np.ndarray) -> None:
    geometry = perturbed(ROBOT.geometry, p)
    r = np.array([complex(x, y)])
    assert abs(forward(geometry, inverse(geometry, r)) - r)[0] < 1e-9


@given(xs, ys, deviations)
def test_the_links_keep_their_lengths(x: float, y: float, p: np.ndarray) -> None:
    """Eq. 1 holds for both limbs: what closes the loop is the linkage, not an algebraic accident."""
    geometry = perturbed(ROBOT.geometry, p)
    theta = inverse(geometry, np.array([complex(x, y)]))
    elbow = geometry.e + geometry.L * np.exp(1j * theta[0])
    assert np.abs(complex(x, y) - elbow) == pytest.approx(geometry.l, abs=1e-9)


@given(xs, ys, deviations)
def test_jacobians_agree_with_differences(x: float, y: float, p: np.ndarray) -> None:
    nominal = ROBOT.geometry
    theta = inverse(nominal, np.array([complex(x, y)]))

    def at(q: np.ndarray) -> tuple[float, complex]:
        here = pose(perturbed(nominal, q), theta + q[:2])
        return float(here.rho[0]), complex(here.r[0])

    here = pose(perturbed(nominal, p), theta + p[:2])
    distance = distance_jacobian(perturbed(nominal, p), here)[0]
    position = position_jacobian(perturbed(nominal, p), here)[0]
    for k in range(len(NAMES)):
        step = np.zeros(len(NAMES))
        step[k] = 1e-5 if k < 2 else 1e-3
        (rho1, r1), (rho0, r0) = at(p + step), at(p - step)
        scale = 375.0 if k < 2 else 1.0
        assert (rho1 - rho0) / (2 * step[k]) == pytest.approx(distance[k], abs=1e-6 * scale)
        slope = (r1 - r0) / (2 * step[k])
        assert [slope.real, slope.imag] == pytest.approx(position[:, k].tolist(), abs=1e-6 * scale)
    assert distance_by_joint(here)[0] == pytest.approx(distance[:2], abs=1e-9)


def test_out_of_reach_is_named() -> None:
    with pytest.raises(Unreachable, match=r"\(900\.0, -900\.0\) mm is out of reach"):
        inverse(ROBOT.geometry, np.array([-700j, 900 - 900j]))
    short = perturbed(ROBOT.geometry, np.r_[np.zeros(8), -500.0, -500.0, 0.0, 0.0])
    with pytest.raises(Unreachable, match=r"does not close at 0\.000, 180\.000 deg"):
        forward(short, np.array([[2.0, np.pi - 2.0], [0.0, np.pi]]))


def test_vectorised_over_positions() -> None:
    r = ROBOT.workspace_grid(5, 4)
    assert inverse(ROBOT.geometry, r).shape == (20, 2)
    one_by_one = np.concatenate([inverse(ROBOT.geometry, r[k : k + 1]) for k in range(20)])
    assert np.array_equal(inverse(ROBOT.geometry, r), one_by_one)
