"""Readings in time order: several consecutive ones with similar deviations indicate an event."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from station.records import Flags, Index, Measurements

RUN = 3


def in_runs(m: Measurements, alike: Callable[[Index], bool]) -> Flags:
    """(K,) readings in runs of `RUN` or more, in time order.

    :param alike: judges any `RUN` consecutive readings, by their indices (RUN,)
    """
    order = np.argsort(m.t_s, kind="stable")
    out = np.zeros(len(m), dtype=bool)
    for k in range(len(m) - RUN + 1):
        row = order[k : k + RUN]
        if alike(row):
            out[row] = True
    return out
