"""Columns that only label or order readings: position, time, approach."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from station.diagnosis.mistakes.defects import drift, plays, smooth
from station.diagnosis.mistakes.fitting import Fitted, fit
from station.diagnosis.mistakes.mistake import Context, Mistake, ids, named, rows_named
from station.five_bar import Robot
from station.records import Measurements, Phrase, Real, phrase, with_guesses

APART_DEG = 0.3
"""Largest deviation between readings of one position; servos stop within hundredths of a degree."""
LEAST_DT_S = 0.1
"""No arm moves, settles and is read in less time."""
LONGEST_DT_S = 600.0
SLOWEST_DEG_PER_S = 0.2
SAME_WAY = 1e-6
"""Share of a motion below which all motions count as equal."""
ALIKE, LESS = 0.95, 0.2
"""Correlation of the time between readings with the motion between them that shows they match; and how much
lower it is for the unchanged rows where a column is shifted.
"""
WAY_DEG = 0.05
FEWEST = 20
AGREE = 0.95
FAR_BETTER = 40.0
"""Minimum gain in deviance: e^20 times more probable."""


def position_labels(m: Measurements, context: Context) -> Mistake | None:
    """Readings of one position that are far from each other."""
    if not context.position_recorded:
        return None
    theta = np.degrees(m.theta)
    wrong: list[int] = []
    for label in np.unique(m.position):
        rows = np.flatnonzero(m.position == label)
        middle = np.median(theta[rows], axis=0)
        far = np.abs(theta[rows] - middle).max(axis=1) > APART_DEG
        wrong += rows[far].tolist()
    if not wrong:
        return None
    rows_at_fault = ids(m, sorted(wrong))
    where = phrase("all_rows") if len(wrong) > 0.9 * len(m) else named(rows_at_fault)
    return Mistake(
        "position_labels",
        phrase("position_labels", rows=where),
        rows_at_fault,
        "label",
    )


def time_column(m: Measurements) -> Mistake | None:
    """A time that no arm can achieve, or that belongs to other rows."""
    gaps = np.diff(m.t_s)
    backwards = np.flatnonzero(gaps < 0)
    if backwards.size:
        rows = ids(m, backwards + 1)
        return _time(phrase("time_backwards", rows=named(rows)), rows)
    if len(m) < FEWEST:
        return None
    way = np.degrees(np.abs(np.diff(m.theta, axis=0)).max(axis=1))
    still = np.flatnonzero((gaps <= 0) & (way > 1.0))
    if len(still) > max(2, len(gaps) // 20):
        rows = ids(m, still + 1)
        return _time(phrase("time_still", rows=named(rows)), rows)
    middle = float(np.median(gaps))
    if middle < LEAST_DT_S:
        return _time(phrase("time_too_short", seconds=middle), ())
    along = _correlation(gaps, way)
    spread = way - way.mean()
    slope = float(spread @ gaps / (spread @ spread)) if np.ptp(way) > SAME_WAY * way.mean() else 0.0
    if middle > LONGEST_DT_S or (along > ALIKE and slope > 1.0 / SLOWEST_DEG_PER_S):
        return _time(phrase("time_too_long", seconds=middle), ())
    for by in (1, -1, 2, -2) if along < 1.0 - LESS else ():
        moved = _correlation(
            gaps[max(by, 0) : len(gaps) + min(by, 0)], way[max(-by, 0) : len(way) - max(by, 0)]
        )
        if moved > ALIKE and along < moved - LESS:
            late = phrase("time_late" if by > 0 else "time_early", rows=rows_named(by))
            return _time(late, ids(m, range(len(m))))
    return None


def _time(what: Phrase, rows: tuple[int | str, ...]) -> Mistake:
    return Mistake("time", phrase("time", what=what), rows, "label")


def _correlation(a: Real, b: Real) -> float:
    if len(a) < FEWEST or np.ptp(a) == 0.0 or np.ptp(b) == 0.0:
        return 0.0
    from scipy.stats import rankdata  # here, because it takes a second to load and few files need it

    return float(np.corrcoef(rankdata(a), rankdata(b))[0, 1])


def approach_columns(robot: Robot, m: Measurements) -> Mistake | None:
    """Approach columns that contradict the order of the rows: reversed, exchanged, or shifted by a row."""
    if not m.approach.any():
        return None
    moved = np.where(
        np.abs(np.diff(m.theta, axis=0)) > np.radians(WAY_DEG), np.sign(np.diff(m.theta, axis=0)), 0
    )
    recorded = m.approach[1:].astype(float)
    own = [_agreement(recorded[:, i], moved[:, i]) for i in (0, 1)]
    reversed_joints = [i for i in (0, 1) if own[i] is not None and own[i] < 1.0 - AGREE]  # type: ignore[operator]
    if reversed_joints and not _positive_play(robot, m, reversed_joints):
        columns = tuple(f"approach{i + 1}" for i in reversed_joints)
        return _approach(phrase("approach_reversed", columns=columns), m)
    if any(a is None or a > AGREE for a in own):
        if all(a is None or a > AGREE for a in own):
            return None
        return _one_column(m, recorded, moved, own)
    crossed = [_agreement(recorded[:, i], moved[:, 1 - i]) for i in (0, 1)]
    if all(a is not None and a > AGREE for a in crossed):
        return _approach(phrase("approach_exchanged"), m)
    for by in (1, -1):
        late = [
            _agreement(
                recorded[max(by, 0) : len(recorded) + min(by, 0), i],
                moved[max(-by, 0) : len(moved) - max(by, 0), i],
            )
            for i in (0, 1)
        ]
        if all(a is not None and a > AGREE for a in late):
            return _approach(phrase("approach_late" if by > 0 else "approach_early"), m)
    return None


def _one_column(m: Measurements, recorded: Real, moved: Real, own: list[float | None]) -> Mistake | None:
    for i in (0, 1):
        a = own[i]
        if a is None or a > AGREE:
            continue
        other = _agreement(recorded[:, i], moved[:, 1 - i])
        if other is not None and other > AGREE:
            return _approach(phrase("approach_of_other", column=f"approach{i + 1}", joint=2 - i), m)
    return None


def _agreement(recorded: Real, moved: Real) -> float | None:
    judged = (recorded != 0) & (moved != 0)
    if judged.sum() < FEWEST:
        return None
    return float(np.mean(recorded[judged] == moved[judged]))


def _positive_play(robot: Robot, m: Measurements, joints: list[int]) -> bool:
    """Whether backlash with the recorded sign is present: then the order of the rows is wrong."""
    found = fit(robot, m, extras=plays(m))
    if found is None:
        return False
    return any(
        found.extra.get(f"play{i + 1}", 0.0) > 6.0 * found.extra_sd.get(f"play{i + 1}", 1.0) for i in joints
    )


def _approach(what: Phrase, m: Measurements) -> Mistake:
    return Mistake("approach_sign", phrase("approach", what=what), ids(m, range(len(m))), "label")


def approach_missing(robot: Robot, m: Measurements, base: Fitted, context: Context) -> Mistake | None:
    """No approach is recorded, and with the approach inferred from the order of the rows backlash appears."""
    if context.approach_recorded:
        return None
    guessed = with_guesses(replace(m, approach=np.zeros_like(m.approach)))
    others = [fit(robot, m, extras=extras, start=base.p) for extras in (smooth(robot, m), (drift(m),))]
    without = [base.deviance, *(other.deviance for other in others if other is not None)]
    found = fit(robot, guessed, extras=plays(guessed), start=base.p)
    if found is None or min(without) - found.deviance < FAR_BETTER:
        return None
    if not any(found.extra[name] > 6.0 * found.extra_sd[name] for name in found.extra):
        return None
    return Mistake("approach_missing", phrase("approach_missing"), (), "label")
