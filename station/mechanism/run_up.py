"""When joints make a run-up: so that play and friction are taken up in a known sense.

A joint whose way is shorter than the run-up may still rest on the other side of its play, whatever the sign
of its last motion.
"""

from __future__ import annotations

import numpy as np

from station.records import Flags, Index, Real

STILL_DEG = 0.004
"""Two pulses: a shorter motion has no sense."""


def last_senses(wanted: Real | Index, way_deg: Real) -> Index:
    """(..., n) sense in which each joint moves last: the wanted one, else that of its way; 0 for no motion.

    :param wanted: (..., n) signs, 0 where the sense does not matter
    :param way_deg: (..., n) from here to the target
    """
    own = np.where(np.abs(way_deg) > STILL_DEG, np.sign(way_deg), 0.0)
    return np.where(np.asarray(wanted) != 0, wanted, own).astype(np.intp)


def needs_run_up(senses: Index, way_deg: Real, run_up_deg: float) -> Flags:
    """(...,) whether the straight way of a joint is too short for its last sense, or leads the other way.

    :param senses: (..., n) of `last_senses`
    """
    return np.asarray(((senses != 0) & (senses * way_deg < run_up_deg)).any(axis=-1))
