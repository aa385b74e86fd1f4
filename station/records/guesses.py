"""Data that a log does not contain but its rows imply: the approach of each joint, and equal poses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.messages import Language, certificate_text, report_text
from station.records.measurements import Measurements
from station.records.motion_between import order_of_time, speeds, steps
from station.records.types import Index, Real

STILL_RAD = 1e-4
"""A joint that moved less between two rows only held its position."""
TIME = "time"
"""Marks the time as guessed: the rows are in order, but their times are unknown."""
EQUAL_S = 1e-3
TURN = 2.0 * np.pi
LEAST_GAP_RAD = 0.2
"""Minimum part of a turn without readings, for a joint to count as one that does not turn all the way."""
SAME_POSE_DEG = 0.02
"""Poses that agree this well in all joints are one position: an arm's drives are not more repeatable."""


def with_guesses(m: Measurements) -> Measurements:
    """The same readings, with missing approaches and positions inferred and marked as guessed."""
    guessed = []
    m = replace(m, theta=_unwrapped(m.theta))
    timed = not counts_rows(m)
    m = replace(m, step=steps(m), speed=speeds(m, m.t_s if timed else _rows(m.t_s)))
    if not m.approach.any():
        order = order_of_time(m)
        approach = np.empty_like(m.approach)
        approach[order] = _approaches(m.theta[order])
        m = replace(m, approach=approach)
        guessed.append("approach")
    if len(np.unique(m.position)) == len(m):
        m = replace(m, position=_places(m.theta))
        guessed.append("position")
    if not timed:
        guessed.append(TIME)
    return replace(m, guessed=tuple(guessed))


def counts_rows(m: Measurements) -> bool:
    """Whether the time only numbers the rows: no real clock has equal steps to the millisecond.

    Where rows were left out, the numbers of the readings have the same gaps.
    """
    steps = np.diff(m.t_s)
    if not len(steps):
        return False
    if np.ptp(steps) < EQUAL_S:
        return True
    gaps = np.diff(m.numbers)
    return bool(gaps.min() > 0.0 and np.abs(steps - gaps * (steps.sum() / gaps.sum())).max() < EQUAL_S)


def _rows(t_s: Real) -> Real:
    """(K,) numbers of the rows, from a column that only numbers them."""
    least = np.diff(t_s).min()
    return np.arange(len(t_s), dtype=float) if least < EQUAL_S else np.round((t_s - t_s[0]) / least)


def guesses_in_words(m: Measurements, language: Language = "en") -> str:
    """The inferred data, in words."""
    names = [report_text(f"guessed_{name}", language) for name in m.guessed if name != TIME]
    and_ = certificate_text("and", language)
    texts = [report_text("guessed", language, names=and_.join(names))] if names else []
    if TIME in m.guessed:
        texts.append(report_text("guessed_time", language))
    return report_text("between_sentences", language).join(texts)


def _unwrapped(theta: Real) -> Real:
    """(K, n) the same poses; joints that seem to turn more than once are brought into one turn.

    A controller that adds whole turns spreads a joint over two; the turn is cut where there is no reading.
    """
    out = theta.copy()
    for i in np.flatnonzero(np.ptp(theta, axis=0) > TURN):
        on_circle = np.sort(np.mod(theta[:, i], TURN))
        gaps = np.diff(on_circle, append=on_circle[0] + TURN)
        widest = int(np.argmax(gaps))
        if gaps[widest] < LEAST_GAP_RAD:
            continue  # it may have turned all the way round
        cut = on_circle[widest] + gaps[widest] / 2.0
        turned = np.mod(theta[:, i] - cut, TURN) + cut
        out[:, i] = turned - TURN * np.round(np.median(turned - theta[:, i]) / TURN)
    return out


def _approaches(theta: Real) -> np.ndarray:
    """(K, n) sense of each joint's last motion in the order of the rows; 0 before the first."""
    way = np.diff(theta, axis=0, prepend=theta[:1])
    moved = np.where(np.abs(way) < STILL_RAD, 0.0, np.sign(way))
    # a joint at standstill retains the sense of its last motion
    last = np.maximum.accumulate(np.where(moved != 0.0, np.arange(len(theta))[:, None], 0), axis=0)
    return np.take_along_axis(moved, last, axis=0).astype(np.int8)


def _places(theta: Real) -> Index:
    """(K,) index of the position, equal for poses that agree."""
    cells = np.round(np.degrees(theta) / SAME_POSE_DEG).astype(np.int64)
    return np.unique(cells, axis=0, return_inverse=True)[1].reshape(-1).astype(np.intp)
