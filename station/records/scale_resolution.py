"""The step of a readout, determined from its readings."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

_UNIT_MM = 1e-4
_EXACT = 2.0**53
"""Whole numbers below this are exact."""
_LEAST_MM = 1e-3
"""Finer steps are within the specified noise of a reading."""


def readout_step_mm(samples_mm: Iterable[float]) -> float:
    """Largest step that all samples are multiples of, apart from a constant; 0 if they are all equal."""
    units = np.rint(np.fromiter(samples_mm, dtype=float) / _UNIT_MM)
    units = units[np.abs(units) < _EXACT].astype(np.int64)
    return int(np.gcd.reduce(units - units[0])) * _UNIT_MM if len(units) else 0.0


def scale_resolution_mm(samples_mm: Iterable[float]) -> float:
    """The step of the readout if it is relevant, otherwise 0.

    A readout with a coarse step repeats the same value: its repeats do not show its possible error, and their
    mean is no better than one of them.
    """
    step_mm = readout_step_mm(samples_mm)
    return step_mm if step_mm >= _LEAST_MM else 0.0
