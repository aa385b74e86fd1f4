"""The motion of an arm from reading to reading, in the order of time."""

from __future__ import annotations

import numpy as np

from station.records.measurements import Measurements
from station.records.types import Index, Real


def order_of_time(m: Measurements) -> Index:
    """(K,) rows in the order in which they were measured; rows of equal time as they stand."""
    return np.argsort(m.t_s, kind="stable")


def steps(m: Measurements) -> Real:
    """(K, n) motion of each joint from the reading before in time, rad; 0 for the first of a set-up."""
    order = order_of_time(m)
    theta, setup = m.theta[order], m.setup_index[order]
    moved = np.diff(theta, axis=0, prepend=theta[:1])
    moved[1:][setup[1:] != setup[:-1]] = 0.0
    out = np.empty_like(moved)
    out[order] = moved
    return out


def speeds(m: Measurements, t_s: Real) -> Real:
    """(K, n) speed of each joint, rad/s: the difference of the readings before and after; 0 if unknown.

    :param t_s: (K,) times, or row numbers if there are none
    """
    order = order_of_time(m)
    theta, t, setup = m.theta[order], t_s[order], m.setup_index[order]
    k = np.arange(len(m))
    before, after = np.maximum(k - 1, 0), np.minimum(k + 1, len(m) - 1)
    before = np.where(setup[before] == setup, before, k)
    after = np.where(setup[after] == setup, after, k)
    passed = t[after] - t[before]
    moved = theta[after] - theta[before]
    out = np.zeros_like(m.theta)
    known = passed > 0.0
    out[order[known]] = moved[known] / passed[known, None]
    return out
