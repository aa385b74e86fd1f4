"""Readings that are copies: fresh readings that are the old ones, a block pasted twice, a frozen readout."""

from __future__ import annotations

import numpy as np

from station.diagnosis.mistakes.mistake import Context, Mistake, ids, named
from station.five_bar import Robot, distance_by_joint, pose
from station.records import Measurements, Phrase, Real, phrase

SAME_RAD, SAME_MM = 1e-9, 1e-9
CHANCE = 1e-6
"""Probability below which equal values are not attributed to chance."""
FEWEST_COPIES = 3
FEWEST_STUCK = 3
STUCK_MOVES_MM = 0.5
"""Minimum motion of the head while the readout was frozen."""
OFTEN = 5
"""How often one reading may occur at different positions before the readout counts as frozen there."""


def same_readings(m: Measurements, fresh: Measurements) -> Mistake | None:
    """Fresh readings that are copies of the sequence, whatever their ids and times."""
    old = {_row(m, k) for k in range(len(m))}
    copied = [k for k in range(len(fresh)) if _row(fresh, k) in old]
    if len(copied) < max(FEWEST_COPIES, len(fresh) // 10) or _rarely(m, fresh) ** len(copied) > CHANCE:
        return None
    rows = ids(fresh, copied)
    return Mistake(
        "same_readings",
        phrase("same_readings", rows=_whole(rows, len(fresh))),
        rows,
        "refused",
        "fresh",
    )


def _row(m: Measurements, k: int) -> tuple[float, ...]:
    return (*(round(float(v), 9) for v in m.theta[k]), round(float(m.distance[k]), 9))


def _rarely(m: Measurements, fresh: Measurements) -> float:
    """Probability that an honest fresh reading equals an old one: small where the resolution is fine."""
    values = np.concatenate([m.distance, fresh.distance])
    step = _step(values)
    return float(min(0.5, step / 2e-3 * 0.4)) if step else 1e-3


def _step(values: Real) -> float:
    """Resolution of a column, mm: the largest decimal step that all values are multiples of."""
    for digits in range(7):
        if np.allclose(values, np.round(values, digits), rtol=0.0, atol=1e-9):
            return float(10.0**-digits)
    return 0.0


def _whole(rows: tuple[int | str, ...], count: int) -> Phrase:
    return phrase("all_readings") if len(rows) == count else named(rows)


def pasted_block(robot: Robot, m: Measurements, file: str = "readings") -> Mistake | None:
    """A run of distances, or of whole rows, that occurs twice."""
    equal = np.abs(m.distance[:, None] - m.distance[None, :]) < SAME_MM
    best: tuple[int, int, int] | None = None
    for lag in range(1, len(m)):
        same = np.diagonal(equal, lag)
        for first, length in _runs(same):
            if length >= FEWEST_COPIES and (best is None or length > best[2]):
                best = first, first + lag, length
    if best is None:
        return None
    source, copy, length = best
    was, now = np.arange(source, source + length), np.arange(copy, copy + length)
    if np.ptp(m.distance[was]) < STUCK_MOVES_MM:
        return None  # a frozen readout
    apart = np.abs(m.theta[was] - m.theta[now]).max(axis=1)
    moved = _moves_mm(robot, m, was, now)
    whole = bool(np.all(apart < SAME_RAD))
    step = _step(m.distance)
    honest = min(0.5, max(step, 1e-6) / 4e-3)
    if whole:
        # honest repeats on the same pulses agree occasionally
        if honest**length * len(m) ** 2 > CHANCE:
            return None
    elif np.median(moved) < 10 * max(step, 2e-3) and honest**length * len(m) ** 2 > CHANCE:
        return None
    if not whole and np.median(moved) < 0.05:
        return None
    rows = ids(m, now)
    code = "pasted_rows" if whole else "pasted_distances"
    return Mistake(
        "pasted_block",
        phrase(code, rows=named(rows), source=named(ids(m, was))),
        rows,
        "refused",
        "fresh" if file == "fresh" else "readings",
    )


def _runs(same: np.ndarray) -> list[tuple[int, int]]:
    """First index and length of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], same.astype(int), [0]])))
    return [(int(a), int(b - a)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _moves_mm(robot: Robot, m: Measurements, was: np.ndarray, now: np.ndarray) -> Real:
    """Expected difference of the distance between two sets of rows."""
    rho = nominal_mm(robot, m)
    return np.asarray(np.abs(rho[was] - rho[now]))


def nominal_mm(robot: Robot, m: Measurements) -> Real:
    """(K,) distance by the nominal geometry; NaN where the links do not meet."""
    with np.errstate(invalid="ignore"):
        return np.asarray(pose(robot.geometry, m.theta).rho)


def by_joint_mm(robot: Robot, m: Measurements) -> Real:
    """(K, 2) d rho / d theta, mm/rad, by the nominal geometry."""
    with np.errstate(invalid="ignore"):
        return np.asarray(distance_by_joint(pose(robot.geometry, m.theta)))


def readout_stuck(robot: Robot, m: Measurements, file: str = "readings") -> Mistake | None:
    """The same reading at positions that are far apart: consecutively, or repeatedly."""
    rho = nominal_mm(robot, m)
    stuck: set[int] = set()
    for first, length in _runs(np.abs(np.diff(m.distance)) < SAME_MM):
        rows = np.arange(first, first + length + 1)
        if length + 1 >= FEWEST_STUCK and _spread(rho[rows]) > STUCK_MOVES_MM:
            stuck.update(rows.tolist())
    values, where = np.unique(np.round(m.distance, 9), return_inverse=True)
    for v in np.flatnonzero(np.bincount(where, minlength=len(values)) >= OFTEN):
        rows = np.flatnonzero(where == v)
        # clipped at an end of its range; several positions, not repeats of one
        if _spread(rho[rows]) > 10 * STUCK_MOVES_MM:
            stuck.update(rows.tolist())
    if not stuck:
        return None
    rows_at_fault = ids(m, sorted(stuck))
    return Mistake(
        "readout_stuck",
        phrase("readout_stuck", rows=named(rows_at_fault)),
        rows_at_fault,
        "refused",
        "fresh" if file == "fresh" else "readings",
    )


def _spread(values: Real) -> float:
    good = values[np.isfinite(values)]
    return float(np.ptp(good)) if len(good) > 1 else 0.0


def copies(robot: Robot, m: Measurements, fresh: Measurements | None, context: Context) -> Mistake | None:
    """The first of these mistakes that is found."""
    if fresh is not None and (found := same_readings(m, fresh)):
        return found
    for file, readings in (("readings", m), ("fresh", fresh)):
        if readings is not None:
            found = readout_stuck(robot, readings, file) or pasted_block(robot, readings, file)
            if found:
                return found
    return None
