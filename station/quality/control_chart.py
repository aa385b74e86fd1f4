"""Control charts of single values: individuals and moving range, EWMA, and Nelson's run rules.

Montgomery, Introduction to Statistical Quality Control, chapters 6 and 9; Nelson, The Shewhart Control Chart:
Tests for Special Causes, Journal of Quality Technology 16 (1984).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np

from station.records import Flags, Real

D2, D4 = 1.128379, 3.266532
"""Mean range of two normal values over their standard deviation (2 over the root of pi), and the upper limit
of the moving range over its mean: 1 + 3 d3 / d2."""
EWMA_SHARE, EWMA_WIDTH = 0.2, 2.962
"""Weight of the newest value and half width of the limits in standard deviations: without a change an alarm
every 500 values (Lucas and Saccucci 1990)."""
SAME = 1e-12

Rule = Literal["nelson_1", "nelson_2", "nelson_3", "nelson_4", "nelson_5", "nelson_6", "nelson_7", "nelson_8"]


def sd_of_moving_range(values: Real) -> float:
    """Standard deviation from one value to the next, from the mean moving range of values (N,)."""
    return float(np.abs(np.diff(values)).mean()) / D2 if len(values) > 1 else float("nan")


def ewma(values: Real, centre: float, share: float = EWMA_SHARE) -> Real:
    """(N,) exponentially weighted moving average that starts at the centre."""
    from scipy.signal import lfilter  # imported here, because charts are rarely requested

    out, _ = lfilter([share], [1.0, share - 1.0], values, zi=[(1.0 - share) * centre])
    return np.asarray(out)


def ewma_limits(
    count: int, centre: float, sd: float, share: float = EWMA_SHARE, width: float = EWMA_WIDTH
) -> tuple[Real, Real]:
    """(N,) lower and (N,) upper limits; they widen over the first values."""
    grown = 1.0 - (1.0 - share) ** (2.0 * np.arange(1, count + 1))
    half = width * sd * np.sqrt(share / (2.0 - share) * grown)
    return centre - half, centre + half


def run_rules(values: Real, centre: float, sd: float) -> dict[Rule, Flags]:
    """For each of Nelson's rules the values (N,) at which it is broken, as booleans.

    The first rule applies to the value itself; the others to the value that completes the pattern.
    """
    z = (values - centre) / sd if sd > 0.0 else np.zeros(len(values))
    return {rule: broken(z) for rule, broken in _RULES.items()}


def _among(of: Flags, window: int, least: int) -> Flags:
    """(N,) whether `least` of the last `window` are true, the last one among them."""
    total = np.concatenate([np.zeros(window), np.cumsum(of)])
    return np.asarray((total[window:] - total[: len(of)] >= least) & of)


def _both_sides(beyond: float, window: int, least: int) -> Callable[[Real], Flags]:
    """`least` of `window` successive values beyond this many standard deviations, on one side."""
    return lambda z: np.asarray(_among(z > beyond, window, least) | _among(z < -beyond, window, least))


def _trend(z: Real) -> Flags:
    """Six consecutive values, each above the previous one, or each below."""
    step = np.diff(z, prepend=np.nan)
    return np.asarray(_among(step > SAME, 5, 5) | _among(step < -SAME, 5, 5))


def _alternating(z: Real) -> Flags:
    """Fourteen consecutive values, alternately up and down."""
    step = np.diff(z, prepend=np.nan)
    turned = step * np.concatenate([[np.nan], step[:-1]]) < 0.0
    return _among(turned, 12, 12)


def _stratified(z: Real) -> Flags:
    """Fifteen consecutive values within one standard deviation."""
    return _among(np.abs(z) < 1.0, 15, 15)


def _mixture(z: Real) -> Flags:
    """Eight consecutive values beyond one standard deviation, on both sides."""
    both = _among(np.abs(z) > 1.0, 8, 8)
    return np.asarray(both & ~_both_sides(1.0, 8, 8)(z))


_RULES: dict[Rule, Callable[[Real], Flags]] = {
    "nelson_1": lambda z: np.asarray(np.abs(z) > 3.0),
    "nelson_2": _both_sides(0.0, 9, 9),
    "nelson_3": _trend,
    "nelson_4": _alternating,
    "nelson_5": _both_sides(2.0, 3, 2),
    "nelson_6": _both_sides(1.0, 5, 4),
    "nelson_7": _stratified,
    "nelson_8": _mixture,
}
RULE_TEXTS: dict[Rule, str] = {
    "nelson_1": "one value beyond three standard deviations",
    "nelson_2": "nine values in a row on one side of the mean",
    "nelson_3": "six values in a row rising, or falling",
    "nelson_4": "fourteen values in a row up and down in turn",
    "nelson_5": "two of three values beyond two standard deviations on one side",
    "nelson_6": "four of five values beyond one standard deviation on one side",
    "nelson_7": "fifteen values in a row within one standard deviation",
    "nelson_8": "eight values in a row beyond one standard deviation on both sides",
}
