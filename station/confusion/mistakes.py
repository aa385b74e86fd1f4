"""Mistakes made on purpose in simulated files: 77 variants of the contract's kinds.

A variant gets a clean or defective machine's files as they were measured and gives them back as a person or a
program would have spoiled them, with the robot file to read them by.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from station.confusion.machines import FRESH, walk_of
from station.diagnosis.mistakes.fitting import fit
from station.kinematics import Real, inverse
from station.measurements import Measurements
from station.robot import Robot
from station.simulation import SimulatedMachine

Rows = tuple[int | str, ...]
ANGLE_DIGITS, SCALE_DIGITS = 4, 4
"""Decimals of the station's own files, deg and mm."""


@dataclass(frozen=True)
class Files:
    """What is handed to the diagnosis."""

    robot: Robot
    walk: Measurements
    fresh: Measurements
    rows: Rows | None = None
    """Ids at fault, where it is some rows only."""


@dataclass(frozen=True)
class Variant:
    """One mistake."""

    name: str
    kinds: tuple[str, ...]
    """Any of these names it."""
    spoil: Callable[[Files, np.random.Generator], Files]
    play: bool = False
    """Needs a machine whose readings depend on the approach."""
    as_effect: bool = False
    """May be reported as the effect of the same size."""
    harmless: bool = False
    """Leaves the readings as they are: a label, or nothing at all."""
    commanded: bool = False
    """Needs the commanded angles too."""


@dataclass(frozen=True)
class Measured:
    """A machine's files before anything was spoiled."""

    files: Files
    commanded: tuple[Real, Real]
    """(K, 2) deg, of the sequence and of the fresh readings."""


def measured(seed: int, *, play: bool = False, effects: tuple[dict[str, object], ...] = ()) -> Measured:
    """A machine of the paper's robot, drawn at random, without a mistake."""
    rng = np.random.default_rng(seed)
    robot = Robot.default()
    places, labels = walk_of(robot, rng)
    truth = np.concatenate(
        [
            rng.uniform(-np.radians(2.0), np.radians(2.0), 2),
            rng.normal(0.0, 0.025, 8),
            [rng.normal(1.0, 0.06), rng.normal(0.5, 0.04)],
        ]
    )
    if play:
        effects = (*effects, {"kind": "backlash", "joint": int(rng.integers(1, 3)), "width_deg": 0.01})
    machine = SimulatedMachine(robot, truth, "whole pulses", seed, effects)
    theta_deg = np.degrees(inverse(robot.geometry, places))
    taken = _as_written(machine.visit(theta_deg, labels))
    count = len(taken) - FRESH
    files = Files(robot, taken.take(np.arange(count)), taken.take(np.arange(count, len(taken))))
    return Measured(files, (theta_deg[:count], theta_deg[count:]))


def _as_written(m: Measurements) -> Measurements:
    theta = np.radians(np.round(np.degrees(m.theta), ANGLE_DIGITS))
    return replace(m, theta=theta, distance=np.round(m.distance, SCALE_DIGITS), t_s=np.round(m.t_s, 3))


def spoiled(variant: Variant, made: Measured, seed: int) -> Files:
    """The files with the mistake in them."""
    rng = np.random.default_rng([seed, 77])
    files = made.files
    if variant.commanded:
        walk, fresh = made.commanded
        files = replace(
            files,
            walk=_angles(files.walk, np.round(walk, 5)),
            fresh=_angles(files.fresh, np.round(fresh, 5)),
        )
        files = variant.spoil(files, rng)
        return _only_given(files, made.files, variant)
    return variant.spoil(files, rng)


def _only_given(commanded: Files, fed_back: Files, variant: Variant) -> Files:
    if variant.name.endswith("joint 1"):
        theta = np.column_stack([commanded.walk.theta[:, 0], fed_back.walk.theta[:, 1]])
        return replace(
            commanded, walk=replace(fed_back.walk, theta=theta, came_from=None), fresh=fed_back.fresh
        )
    if variant.name.endswith("sequence"):
        return replace(commanded, fresh=fed_back.fresh)
    if variant.name.endswith("fresh"):
        return replace(commanded, walk=fed_back.walk)
    return commanded


# -- how files are spoiled --------------------------------------------------------------------------


def _angles(m: Measurements, degrees: Real) -> Measurements:
    return replace(m, theta=np.radians(degrees), came_from=None)


def _scale(m: Measurements, values: Real) -> Measurements:
    return replace(m, distance=values, came_from=None)


Change = Callable[[Measurements], Measurements]


def _both(change: Change) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, walk=change(f.walk), fresh=change(f.fresh))


def _walk(change: Change) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, walk=change(f.walk))


def _fresh(change: Change) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, fresh=change(f.fresh))


def _on_rows(change: Change, first: float, last: float) -> Callable[[Files, np.random.Generator], Files]:
    """On the rows from a share of the file to another one."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        m, changed = f.walk, change(f.walk)
        n = len(m)
        rows = np.zeros(n, dtype=bool)
        rows[int(first * n) : int(last * n)] = True
        walk = replace(
            m,
            theta=np.where(rows[:, None], changed.theta, m.theta),
            distance=np.where(rows, changed.distance, m.distance),
            approach=np.where(rows[:, None], changed.approach, m.approach),
            position=np.where(rows, changed.position, m.position),
            came_from=None,
        )
        return replace(f, walk=walk, rows=tuple(m.ids[k] for k in np.flatnonzero(rows)))

    return spoil


def _factor(by: float, digits: int = SCALE_DIGITS) -> Change:
    return lambda m: _scale(m, np.round(m.distance * by, digits))


def _turn(
    by: float, joints: tuple[int, ...] = (0, 1), digits: int = 6, about: tuple[float, float] = (0.0, 0.0)
) -> Change:
    def change(m: Measurements) -> Measurements:
        degrees = np.degrees(m.theta)
        for i in joints:
            degrees[:, i] = np.round(about[i] + (degrees[:, i] - about[i]) * by, digits)
        return _angles(m, degrees)

    return change


def _add(offsets: tuple[float, float]) -> Change:
    return lambda m: _angles(m, np.degrees(m.theta) + np.array(offsets))


def _exchange(m: Measurements) -> Measurements:
    return replace(m, theta=m.theta[:, ::-1].copy(), came_from=None)


def _shift(column: str, by: int) -> Change:
    """Values move down by so many rows; rows that lose theirs are left out."""

    def change(m: Measurements) -> Measurements:
        moved = move(m)
        return moved.take(np.arange(len(m))[max(by, 0) : len(m) + min(by, 0)])

    def move(m: Measurements) -> Measurements:
        source = np.clip(np.arange(len(m)) - by, 0, len(m) - 1)
        if column == "scale":
            return _scale(m, m.distance[source])
        theta = m.theta.copy()
        for i in (0, 1):
            if column in ("both", f"joint {i + 1}"):
                theta[:, i] = theta[source, i]
        return replace(m, theta=theta, came_from=None)

    return change


def _scale_down_from(first: float) -> Callable[[Files, np.random.Generator], Files]:
    """A cell inserted in the column of the readings; its row, which has none then, is left out."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        m, n = f.walk, len(f.walk)
        row = int(first * n)
        source = np.arange(n)
        source[row:] -= 1
        kept = np.delete(np.arange(n), row)
        walk = _scale(m, m.distance[source]).take(kept)
        return replace(f, walk=replace(walk, came_from=None), rows=tuple(m.ids[k] for k in range(row + 1, n)))

    return spoil


def _step(steps_mm: tuple[tuple[float, float, float], ...]) -> Callable[[Files, np.random.Generator], Files]:
    """(first share, last share, mm) of the sequence; what lasts to its end lasts in the fresh file too."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        values, n = f.walk.distance.copy(), len(f.walk)
        fresh = f.fresh
        rows: list[int] = []
        for first, last, mm in steps_mm:
            chosen = np.arange(int(first * n), int(last * n))
            values[chosen] += mm
            rows += chosen.tolist()
            if last >= 1.0:
                fresh = _scale(fresh, fresh.distance + mm)
        return Files(f.robot, _scale(f.walk, values), fresh, tuple(f.walk.ids[k] for k in sorted(set(rows))))

    return spoil


def _stuck(count: int, runs: int = 1) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        values = f.walk.distance.copy()
        rows: list[int] = []
        for first in rng.choice(len(values) // count - 1, runs, replace=False) * count:
            values[first : first + count] = values[first]
            rows += list(range(int(first), int(first) + count))
        return replace(f, walk=_scale(f.walk, values), rows=tuple(f.walk.ids[k] for k in sorted(rows)))

    return spoil


def _clipped(f: Files, rng: np.random.Generator) -> Files:
    limit = float(np.quantile(f.walk.distance, 0.85))
    rows = np.flatnonzero(f.walk.distance > limit)
    walk = _scale(f.walk, np.minimum(f.walk.distance, limit))
    return replace(f, walk=walk, rows=tuple(f.walk.ids[k] for k in rows))


def _pasted(count: int, *, whole: bool = False) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        n = len(f.walk)
        first = int(rng.integers(0, n - 2 * count))
        copy = int(rng.integers(first + count, n - count + 1))
        source = np.arange(n)
        source[copy : copy + count] = np.arange(first, first + count)
        walk = _scale(f.walk, f.walk.distance[source])
        if whole:
            walk = replace(walk, theta=f.walk.theta[source], came_from=None)
        return replace(f, walk=walk, rows=tuple(f.walk.ids[k] for k in range(copy, copy + count)))

    return spoil


def _robot(**changes: object) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, robot=replace(f.robot, **changes))  # type: ignore[arg-type]


def _labels(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, walk=replace(f.walk, position=change(f.walk.position)))


def _approach(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Files, np.random.Generator], Files]:
    return _both(lambda m: replace(m, approach=change(m.approach).astype(np.int8)))


def _time(change: Callable[[Real], Real]) -> Callable[[Files, np.random.Generator], Files]:
    return _both(lambda m: replace(m, t_s=change(m.t_s)))


def _copied(share: float, *, shuffled: bool = False) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        count = int(share * len(f.walk))
        rows = rng.permutation(len(f.walk))[:count] if shuffled else np.arange(count)
        return replace(f, fresh=replace(f.walk.take(rows), ids=tuple(range(1001, 1001 + count))))

    return spoil


def _homed(by: tuple[float, float]) -> Callable[[Files, np.random.Generator], Files]:
    """The drive's count changes by so much before the fresh readings."""
    return _fresh(_add(by))


def _written(*, sign: float = -1.0, between: bool = False) -> Callable[[Files, np.random.Generator], Files]:
    """Stands for zeros written: `by` is set from the fit, as the station would."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        found = fit(f.robot, f.walk)
        by = sign * np.degrees(found.p[:2]) if found is not None else np.zeros(2)
        # feedback of the same pose counts from the new zero
        fresh = _add((-float(by[0]), -float(by[1])))(f.fresh)
        if between:
            return replace(f, fresh=fresh)
        row = int(rng.integers(len(f.walk) // 4, 3 * len(f.walk) // 4))
        degrees = np.degrees(f.walk.theta)
        degrees[row:] -= by
        return Files(f.robot, _angles(f.walk, degrees), fresh, tuple(f.walk.ids[row:]))

    return spoil


def _glitched(count: int, mm: float) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        rows = np.sort(rng.choice(len(f.walk), count, replace=False))
        values = f.walk.distance.copy()
        values[rows] += rng.choice([-1.0, 1.0], count) * mm * rng.uniform(0.5, 2.0, count)
        return replace(f, walk=_scale(f.walk, values), rows=tuple(f.walk.ids[k] for k in rows))

    return spoil


def _digit_exchanged(f: Files, rng: np.random.Generator) -> Files:
    """Two neighbouring digits of one reading."""
    row = int(rng.integers(len(f.walk)))
    values = f.walk.distance.copy()
    values[row] += 9.0 if values[row] < 50.0 else -9.0
    return replace(f, walk=_scale(f.walk, values), rows=(f.walk.ids[row],))


ZEROS = (0.0, 180.0)
RAD = np.pi / 180.0
VARIANTS: tuple[Variant, ...] = (
    Variant("scale_sign: both files", ("scale_sign",), _both(_factor(-1.0))),
    Variant("scale_sign: sequence only", ("scale_sign",), _walk(_factor(-1.0))),
    Variant("scale_sign: fresh only", ("scale_sign",), _fresh(_factor(-1.0))),
    Variant("scale_sign: last third", ("scale_sign",), _on_rows(_factor(-1.0), 0.67, 1.0)),
    Variant("scale_unit: inches", ("scale_unit",), _both(_factor(1 / 25.4, 5))),
    Variant("scale_unit: metres", ("scale_unit",), _both(_factor(1e-3, 6))),
    Variant("scale_unit: micrometres", ("scale_unit",), _both(_factor(1e3, 1))),
    Variant("scale_unit: centimetres", ("scale_unit",), _both(_factor(0.1, 5))),
    Variant("scale_unit: inches, fresh only", ("scale_unit",), _fresh(_factor(1 / 25.4, 5))),
    Variant("scale_unit: inches, rows 30 to 60 %", ("scale_unit",), _on_rows(_factor(1 / 25.4, 5), 0.3, 0.6)),
    Variant("scale_factor: half", ("scale_factor",), _both(_factor(0.5))),
    Variant("scale_factor: four times", ("scale_factor",), _both(_factor(4.0))),
    Variant("scale_factor: 1.1", ("scale_factor",), _both(_factor(1.1))),
    Variant("scale_factor: 1.01", ("scale_factor",), _both(_factor(1.01)), as_effect=True),
    Variant("angle_unit: radians", ("angle_unit",), _both(_turn(RAD))),
    Variant("angle_unit: minutes of arc", ("angle_unit",), _both(_turn(60.0))),
    Variant("angle_unit: gon", ("angle_unit", "ratio"), _both(_turn(10 / 9))),
    Variant("angle_unit: radians, joint 1", ("angle_unit", "ratio"), _both(_turn(RAD, (0,)))),
    Variant("angle_unit: radians, joint 2", ("angle_unit", "ratio"), _both(_turn(RAD, (1,)))),
    Variant("angle_unit: radians, fresh only", ("angle_unit",), _fresh(_turn(RAD))),
    Variant("joint_sign: joint 1", ("joint_sign",), _both(_turn(-1.0, (0,), about=ZEROS))),
    Variant("joint_sign: joint 2", ("joint_sign",), _both(_turn(-1.0, (1,), about=ZEROS))),
    Variant("joint_sign: both", ("joint_sign",), _both(_turn(-1.0, about=ZEROS))),
    Variant("joint_sign: joint 2, about 0", ("joint_sign",), _both(_turn(-1.0, (1,)))),
    Variant("joint_sign: joint 1, fresh only", ("joint_sign",), _fresh(_turn(-1.0, (0,)))),
    Variant("joints_exchanged: both files", ("joints_exchanged",), _both(_exchange)),
    Variant("joints_exchanged: fresh only", ("joints_exchanged",), _fresh(_exchange)),
    Variant("joints_exchanged: first third", ("joints_exchanged",), _on_rows(_exchange, 0.0, 0.33)),
    Variant("row_shift: scale down", ("row_shift",), _both(_shift("scale", 1))),
    Variant("row_shift: scale up", ("row_shift",), _both(_shift("scale", -1))),
    Variant("row_shift: scale by two", ("row_shift",), _both(_shift("scale", 2))),
    Variant("row_shift: joint 1 down", ("row_shift",), _both(_shift("joint 1", 1))),
    Variant("row_shift: joint 2 up", ("row_shift",), _both(_shift("joint 2", -1))),
    Variant("row_shift: both joints down", ("row_shift",), _both(_shift("both", 1))),
    Variant("row_shift: scale, from the middle on", ("row_shift",), _scale_down_from(0.5)),
    Variant("row_shift: scale, from a fifth on", ("row_shift",), _scale_down_from(0.2)),
    Variant("row_shift: scale, fresh only", ("row_shift",), _fresh(_shift("scale", 1))),
    Variant("zero_at: joint 1, 20 deg", ("zero_at",), _both(_add((20.0, 0.0)))),
    Variant("zero_at: joint 2, -10 deg", ("zero_at",), _both(_add((0.0, -10.0)))),
    Variant("zero_at: joint 2, 180 deg", ("zero_at",), _both(_add((0.0, -180.0)))),
    Variant("zero_at: joint 1, 90 deg", ("zero_at",), _both(_add((-90.0, 0.0)))),
    Variant("zero_at: both, 15 and -8 deg", ("zero_at",), _both(_add((15.0, -8.0)))),
    Variant("ratio: both, 2", ("ratio",), _both(_turn(2.0, about=ZEROS))),
    Variant("ratio: both, 0.8", ("ratio",), _both(_turn(0.8, about=ZEROS))),
    Variant("ratio: joint 1, 0.5", ("ratio",), _both(_turn(0.5, (0,), about=ZEROS))),
    Variant("ratio: both, 1.01", ("ratio",), _both(_turn(1.01, about=ZEROS)), as_effect=True),
    Variant("robot_file: L digits exchanged", ("robot_file",), _robot(L=(357.0, 357.0))),
    Variant("robot_file: l digits exchanged", ("robot_file",), _robot(l=(852.0, 852.0))),
    Variant("robot_file: l1 of another robot", ("robot_file",), _robot(l=(805.0, 825.0))),
    Variant("robot_file: e 10 mm wide", ("robot_file", "mechanism"), _robot(e=((85.0, 0.0), (-85.0, 0.0)))),
    Variant("mechanism: sign of dr_M", ("mechanism",), _robot(drm=(-1.0, -0.5))),
    Variant("mechanism: c digits exchanged", ("mechanism",), _robot(c=(0.0, -97.0))),
    Variant("mechanism: sign of d", ("mechanism",), _robot(d=(0.0, 51.0))),
    Variant("mechanism: c and d left out", ("mechanism",), _robot(c=(0.0, 0.0), d=(0.0, 0.0))),
    Variant("readout_zeroed: middle", ("readout_zeroed",), _step(((0.5, 1.0, 89.7),))),
    Variant("readout_zeroed: twice", ("readout_zeroed",), _step(((0.3, 1.0, -35.2), (0.7, 1.0, 61.0)))),
    Variant("readout_zeroed: for some rows", ("readout_zeroed",), _step(((0.4, 0.6, 12.5),))),
    Variant("readout_zeroed: by 2 mm", ("readout_zeroed",), _step(((0.6, 1.0, 2.0),))),
    Variant(
        "readout_zeroed: before fresh", ("readout_zeroed",), _fresh(lambda m: _scale(m, m.distance + 44.4))
    ),
    Variant("readout_stuck: 8 rows", ("readout_stuck",), _stuck(8)),
    Variant("readout_stuck: 4 rows, three times", ("readout_stuck",), _stuck(4, 3)),
    Variant("readout_stuck: at the end of its range", ("readout_stuck",), _clipped),
    Variant("pasted_block: 45 distances", ("pasted_block",), _pasted(45)),
    Variant("pasted_block: 8 distances", ("pasted_block",), _pasted(8)),
    Variant("pasted_block: 20 whole rows", ("pasted_block",), _pasted(20, whole=True), harmless=True),
    Variant("position_labels: all one", ("position_labels",), _labels(np.zeros_like), harmless=True),
    Variant(
        "position_labels: a row late", ("position_labels",), _labels(lambda p: np.roll(p, 1)), harmless=True
    ),
    Variant("approach_sign: both", ("approach_sign",), _approach(lambda a: -a), play=True, harmless=True),
    Variant(
        "approach_sign: joint 1",
        ("approach_sign",),
        _approach(lambda a: np.column_stack([-a[:, 0], a[:, 1]])),
        play=True,
        harmless=True,
    ),
    Variant("approach_missing: play", ("approach_missing",), _approach(np.zeros_like), play=True),
    Variant("commanded_angles: both files", ("commanded_angles",), lambda f, rng: f, commanded=True),
    Variant("coarse_angles: 0.01 deg", ("coarse_angles",), _both(_turn(1.0, digits=2))),
    Variant("time: milliseconds", ("time",), _time(lambda t: t * 1e3), harmless=True),
    Variant("same_readings: the file again", ("same_readings",), _copied(1.0), harmless=True),
    Variant("rehomed: joint 1 by 0.3 deg", ("rehomed",), _homed((0.3, 0.0))),
    Variant("zeros_written: in the sequence", ("zeros_written",), _written()),
    Variant("glitches: 7 of 0.3 mm", ("glitches",), _glitched(7, 0.3)),
)
MORE: tuple[Variant, ...] = (
    Variant("angle_unit: turns", ("angle_unit",), _both(_turn(1 / 360))),
    Variant("coarse_angles: 0.1 deg", ("coarse_angles",), _both(_turn(1.0, digits=1))),
    Variant("coarse_angles: joint 2, 0.01 deg", ("coarse_angles",), _both(_turn(1.0, (1,), digits=2))),
    Variant("commanded_angles: joint 1", ("commanded_angles",), lambda f, rng: f, commanded=True),
    Variant("commanded_angles: fresh", ("commanded_angles",), lambda f, rng: f, commanded=True),
    Variant("time: minutes", ("time",), _time(lambda t: t / 60), harmless=True),
    Variant(
        "time: a row late",
        ("time",),
        _walk(lambda m: replace(m, t_s=np.concatenate([m.t_s[:1] - 1, m.t_s[:-1]]))),
        harmless=True,
    ),
    Variant(
        "same_readings: 30 of them, shuffled", ("same_readings",), _copied(0.25, shuffled=True), harmless=True
    ),
    Variant("rehomed: joint 2 by 2 deg", ("rehomed",), _homed((0.0, 2.0))),
    Variant("rehomed: both by 0.05 deg", ("rehomed", "zeros_written"), _homed((0.05, -0.05))),
    Variant("zeros_written: before fresh", ("zeros_written", "rehomed"), _written(between=True)),
    Variant("zeros_written: wrong sign", ("zeros_written",), _written(sign=1.0)),
    Variant("glitches: one of 5 mm", ("glitches",), _glitched(1, 5.0)),
    Variant("glitches: digits exchanged", ("glitches",), _digit_exchanged),
    Variant("glitches: 3 of 0.1 mm", ("glitches",), _glitched(3, 0.1)),
    Variant(
        "approach_sign: exchanged",
        ("approach_sign",),
        _approach(lambda a: a[:, ::-1]),
        play=True,
        harmless=True,
    ),
    Variant(
        "position_labels: three wrong",
        ("position_labels",),
        _labels(lambda p: np.where(np.arange(len(p)) % 40 == 20, p[0], p)),
        harmless=True,
    ),
    Variant("robot_file: L1 and l1 exchanged", ("robot_file",), _robot(L=(378.0, 375.0)), as_effect=True),
)
"""Written after the search; two of them (a time column and zeros of the wrong sign) led to changes of it."""
