"""Readings that disagree by millimetres: which correction, on which rows, makes most of them agree.

Every correction is judged by a rough fit.  A mistake in some rows only is found with the parameters on which
the other rows agree: the best run of rows on which the corrected file agrees and the file does not.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.diagnosis.mistakes.corrections import (
    Correction,
    corrections,
    offset_angles,
    on_rows,
    scaled_angles,
    scaled_readings,
)
from station.diagnosis.mistakes.fitting import Rough, costs, mean_cost, rough
from station.five_bar import FiveBar, Robot, pose
from station.records import Flags, Measurements, Real

NO_REACH_MM = 1e3
FACTORS = np.geomspace(0.04, 25.0, 260)
"""Factors of a ratio or a scale."""
KNOWN_FACTORS = (0.5, 2.0, 0.25, 4.0, 0.1, 10.0, 0.2, 5.0, 0.8, 1.25, 0.75, 4.0 / 3.0, 2.0 / 3.0, 1.5)
OFFSETS_DEG = np.arange(-180.0, 180.0, 10.0)
EVERY_SO_MANY = 40
"""Row stride of the first search for zeros and factors."""
MOST_ZEROINGS = 3
AGREES_MM = 0.3
SHORTEST = 3
"""Minimum number of rows of a run."""
PART = 0.9
"""A correction of a smaller share of the rows counts as a partial one."""


@dataclass(frozen=True)
class Found:
    """A correction of some rows, and how well the file then agrees."""

    correction: Correction
    rows: Flags
    """(K,) corrected rows."""
    used: Flags
    """(K,) rows that are still complete."""
    corrected: Measurements
    start: Real
    cost: float


@dataclass(frozen=True)
class Zeroings:
    """Steps of the reading only."""

    rows: tuple[NDArray[np.intp], ...]
    steps_mm: tuple[float, ...]
    start: Real
    cost: float


def majority(robot: Robot, m: Measurements) -> Rough:
    """The rough fit on which most rows agree, using all rows or a part of the file."""
    n = len(m)
    parts = [np.ones(n, dtype=bool)]
    for pieces in (2, 3):
        for k in range(pieces):
            part = np.zeros(n, dtype=bool)
            part[k * n // pieces : (k + 1) * n // pieces] = True
            parts.append(part)
    tried = []
    for part in parts:
        first = rough(robot, m, part)
        good = costs(first.residual_mm) < np.log1p((AGREES_MM / 0.05) ** 2)
        tried.append(first)
        if 6 <= good.sum() < n:
            tried.append(rough(robot, m, good, from_mm=0.4, start=first.p))
    return min(tried, key=lambda one: one.cost)


def whole(robot: Robot, m: Measurements) -> list[Found]:
    """Corrections of the whole file, best first."""
    out = []
    for one in (*corrections(robot), *_searched(robot, m)):
        corrected, used = one.apply(m)
        if not _possible(robot, corrected):
            continue
        fitted = rough(robot, corrected, used)
        cost = mean_cost(fitted.residual_mm[used]) if used.any() else np.inf
        out.append(Found(one, np.ones(len(m), dtype=bool), used, corrected, fitted.p, cost))
    return sorted(out, key=lambda found: found.cost)


def partial(robot: Robot, m: Measurements, agreed: Rough, from_corrected: list[Found]) -> list[Found]:
    """Corrections of one run of rows, best first."""
    starts = [agreed.p, *(found.start for found in from_corrected)]
    mechanism = FiveBar(robot, m)
    out = []
    known = list(corrections(robot))
    for p in starts:
        with np.errstate(invalid="ignore"):
            here = costs(m.distance - mechanism.observe(p, m.theta).value)
        for one in known:
            corrected, used = one.apply(m)
            with np.errstate(invalid="ignore"):
                value = mechanism.observe(p, corrected.theta).value
            there = np.where(used, costs(corrected.distance - value), here)
            rows = best_run(here - there)
            if rows is None or rows.sum() < SHORTEST or rows.sum() > PART * len(m):
                continue
            rows = grown(rows, ~used)
            cost = float(np.sum(np.where(rows, there, here)[used | ~rows]) / len(m))
            out.append(Found(one, rows, used | ~rows, on_rows(m, corrected, rows), p, cost))
    return sorted(out, key=lambda found: found.cost)


def zeroings(robot: Robot, m: Measurements, agreed: Rough) -> Zeroings | None:
    """Runs of rows whose residual under the majority's parameters is one constant."""
    residual = agreed.residual_mm.copy()
    rows: list[NDArray[np.intp]] = []
    steps: list[float] = []
    taken = np.zeros(len(m), dtype=bool)
    for _ in range(MOST_ZEROINGS):
        here = costs(residual)
        best: tuple[float, Flags, float] | None = None
        for value in _levels(residual, taken):
            run = best_run(here - costs(residual - value), ~taken)
            if run is None or run.sum() < SHORTEST:
                continue
            won = float(np.sum((here - costs(residual - value))[run]))
            if best is None or won > best[0]:
                best = won, run, value
        if best is None or best[0] < 5.0 * SHORTEST:
            break
        run = best[1]
        step = float(np.median(residual[run]))
        rows.append(np.flatnonzero(run))
        steps.append(step)
        residual[run] -= step
        taken |= run
    if not rows:
        return None
    level = np.zeros(len(m))
    for chosen, step in zip(rows, steps, strict=True):
        level[chosen] = step
    # any part may be the wrong one; the later one is reported
    start = agreed.p.copy()
    start[len(start) - len(m.mounts) :] -= level[0]
    level -= level[0]
    others = [float(v) for v in dict.fromkeys(level) if abs(v) > AGREES_MM]
    if not others:
        return None
    return Zeroings(
        tuple(np.flatnonzero(level == v) for v in others), tuple(others), start, mean_cost(residual)
    )


def _levels(residual: Real, taken: Flags) -> list[float]:
    """Values that several consecutive rows share."""
    out: list[float] = []
    for k in range(len(residual) - SHORTEST + 1):
        window = residual[k : k + SHORTEST]
        if np.isfinite(window).all() and np.ptp(window) < AGREES_MM and not taken[k : k + SHORTEST].any():
            middle = float(np.median(window))
            if abs(middle) > AGREES_MM and all(abs(middle - one) > AGREES_MM for one in out):
                out.append(middle)
    return out


def best_run(gain: Real, allowed: Flags | None = None) -> Flags | None:
    """(K,) the run of rows with the largest sum of gain (K,), where it is positive."""
    best, best_sum, first, total = None, 0.0, 0, 0.0
    for k, value in enumerate(gain):
        if allowed is not None and not allowed[k]:
            first, total = k + 1, 0.0
            continue
        total += float(value)
        if total > best_sum:
            best, best_sum = (first, k + 1), total
        if total <= 0.0:
            first, total = k + 1, 0.0
    if best is None:
        return None
    out = np.zeros(len(gain), dtype=bool)
    out[best[0] : best[1]] = True
    return out


def grown(rows: Flags, over: Flags) -> Flags:
    """(K,) a run with the rows of `over` (K,) that adjoin it."""
    out = rows.copy()
    first, last = (int(k) for k in np.flatnonzero(rows)[[0, -1]])
    while last + 1 < len(rows) and over[last + 1]:
        last += 1
    while first > 0 and over[first - 1]:
        first -= 1
    out[first : last + 1] = True
    return out


def _possible(robot: Robot, m: Measurements) -> bool:
    """Whether the links meet at nearly all angles."""
    mechanism = FiveBar(robot, m)
    with np.errstate(invalid="ignore"):
        value = mechanism.observe(mechanism.start, m.theta).value
    return bool(np.mean(np.isfinite(value)) > 0.95)


def _searched(robot: Robot, m: Measurements) -> Iterator[Correction]:
    """Zeros, ratios and scale factors with the best agreement under the nominal geometry."""
    few = slice(None, None, max(1, len(m) // EVERY_SO_MANY))
    theta, distance = m.theta[few], m.distance[few]

    def apart(angles: Real, readings: Real) -> Real:
        """(C,) deviation, mm, of C candidates: angles (C, K, 2), readings (C, K)."""
        with np.errstate(invalid="ignore"):
            r = readings - pose(robot.geometry, angles.reshape(-1, 2)).rho.reshape(readings.shape)
        closed = np.isfinite(r)
        r = np.where(closed, r, 0.0)
        off = np.median(np.abs(r - np.median(r, axis=1)[:, None]), axis=1)
        return np.where(np.mean(closed, axis=1) < 0.95, NO_REACH_MM, off)

    pairs = np.array([(a, b) for a in OFFSETS_DEG for b in OFFSETS_DEG if a or b])
    same = np.broadcast_to(distance, (len(pairs), len(distance)))
    ranked = pairs[np.argsort(apart(theta + np.radians(pairs)[:, None, :], same))]
    single = ranked[np.any(ranked == 0.0, axis=1)]
    for a, b in dict.fromkeys((float(a), float(b)) for a, b in (*single[:6], *ranked[:6])):
        yield offset_angles((a, b))
    zero = np.radians(robot.zero_at_deg)
    factors = np.array([*FACTORS, *KNOWN_FACTORS])
    same = np.broadcast_to(distance, (len(factors), len(distance)))
    for joints in ((0,), (1,), (0, 1)):
        angles = np.repeat(theta[None], len(factors), axis=0)
        for i in joints:
            angles[:, :, i] = zero[i] + factors[:, None] * (theta[:, i] - zero[i])
        for f in factors[np.argsort(apart(angles, same))[:3]]:
            yield scaled_angles(joints, float(f), robot.zero_at_deg)
    signed = np.array([*FACTORS, *-FACTORS])
    angles = np.broadcast_to(theta, (len(signed), *theta.shape))
    for f in signed[np.argsort(apart(angles, signed[:, None] * distance))[:3]]:
        yield scaled_readings(float(f))
