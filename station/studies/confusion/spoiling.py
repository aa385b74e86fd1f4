"""Mistakes made on purpose in simulated files: 77 variants of the contract's kinds.

A variant gets a clean or defective machine's files as they were measured and gives them back as a person or a
program would have spoiled them, with the robot file to read them by.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from station.diagnosis import fit_readings
from station.five_bar import Robot
from station.plans import diagnostic_fresh_stops, make_plan
from station.records import Measurements, Real
from station.studies.simulation import SimulatedMachine

Rows = tuple[int | str, ...]
ANGLE_DIGITS, SCALE_DIGITS = 4, 4
"""Decimals of the station's own files, deg and mm."""


@dataclass(frozen=True)
class Files:
    """What is handed to the diagnosis."""

    robot: Robot
    sequence: Measurements
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
    sequence, fresh = (_as_written(m) for m in machine.diagnostic_run(robot, seed))
    commanded = [stop.theta_deg for stop in make_plan("diagnostic", robot).stops]
    afterwards = [stop.theta_deg for stop in diagnostic_fresh_stops(robot, truth[:2], seed)]
    return Measured(Files(robot, sequence, fresh), (np.array(commanded), np.array(afterwards)))


def _as_written(m: Measurements) -> Measurements:
    theta = np.radians(np.round(np.degrees(m.theta), ANGLE_DIGITS))
    return replace(m, theta=theta, distance=np.round(m.distance, SCALE_DIGITS), t_s=np.round(m.t_s, 3))


def spoiled(variant: Variant, made: Measured, seed: int) -> Files:
    """The files with the mistake in them."""
    rng = np.random.default_rng([seed, 77])
    files = made.files
    if variant.commanded:
        sequence, fresh = made.commanded
        files = replace(
            files,
            sequence=_angles(files.sequence, np.round(sequence, 5)),
            fresh=_angles(files.fresh, np.round(fresh, 5)),
        )
        files = variant.spoil(files, rng)
        return _only_given(files, made.files, variant)
    return variant.spoil(files, rng)


def _only_given(commanded: Files, fed_back: Files, variant: Variant) -> Files:
    if variant.name.endswith("joint 1"):
        theta = np.column_stack([commanded.sequence.theta[:, 0], fed_back.sequence.theta[:, 1]])
        return replace(
            commanded, sequence=replace(fed_back.sequence, theta=theta, came_from=None), fresh=fed_back.fresh
        )
    if variant.name.endswith("sequence"):
        return replace(commanded, fresh=fed_back.fresh)
    if variant.name.endswith("fresh"):
        return replace(commanded, sequence=fed_back.sequence)
    return commanded


# -- how files are spoiled --------------------------------------------------------------------------


def _angles(m: Measurements, degrees: Real) -> Measurements:
    return replace(m, theta=np.radians(degrees), came_from=None)


def scale(m: Measurements, values: Real) -> Measurements:
    return replace(m, distance=values, came_from=None)


Change = Callable[[Measurements], Measurements]


def in_both(change: Change) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, sequence=change(f.sequence), fresh=change(f.fresh))


def in_sequence(change: Change) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, sequence=change(f.sequence))


def in_fresh(change: Change) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, fresh=change(f.fresh))


def on_rows(change: Change, first: float, last: float) -> Callable[[Files, np.random.Generator], Files]:
    """On the rows from a share of the file to another one."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        m, changed = f.sequence, change(f.sequence)
        n = len(m)
        rows = np.zeros(n, dtype=bool)
        rows[int(first * n) : int(last * n)] = True
        sequence = replace(
            m,
            theta=np.where(rows[:, None], changed.theta, m.theta),
            distance=np.where(rows, changed.distance, m.distance),
            approach=np.where(rows[:, None], changed.approach, m.approach),
            position=np.where(rows, changed.position, m.position),
            came_from=None,
        )
        return replace(f, sequence=sequence, rows=tuple(m.ids[k] for k in np.flatnonzero(rows)))

    return spoil


def factor(by: float, digits: int = SCALE_DIGITS) -> Change:
    return lambda m: scale(m, np.round(m.distance * by, digits))


def turn(
    by: float, joints: tuple[int, ...] = (0, 1), digits: int = 6, about: tuple[float, float] = (0.0, 0.0)
) -> Change:
    def change(m: Measurements) -> Measurements:
        degrees = np.degrees(m.theta)
        for i in joints:
            degrees[:, i] = np.round(about[i] + (degrees[:, i] - about[i]) * by, digits)
        return _angles(m, degrees)

    return change


def add(offsets: tuple[float, float]) -> Change:
    return lambda m: _angles(m, np.degrees(m.theta) + np.array(offsets))


def exchange(m: Measurements) -> Measurements:
    return replace(m, theta=m.theta[:, ::-1].copy(), came_from=None)


def shift(column: str, by: int) -> Change:
    """Values move down by so many rows; rows that lose theirs are left out."""

    def change(m: Measurements) -> Measurements:
        moved = move(m)
        return moved.take(np.arange(len(m))[max(by, 0) : len(m) + min(by, 0)])

    def move(m: Measurements) -> Measurements:
        source = np.clip(np.arange(len(m)) - by, 0, len(m) - 1)
        if column == "scale":
            return scale(m, m.distance[source])
        theta = m.theta.copy()
        for i in (0, 1):
            if column in ("both", f"joint {i + 1}"):
                theta[:, i] = theta[source, i]
        return replace(m, theta=theta, came_from=None)

    return change


def scale_down_from(first: float) -> Callable[[Files, np.random.Generator], Files]:
    """A cell inserted in the column of the readings; its row, which has none then, is left out."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        m, n = f.sequence, len(f.sequence)
        row = int(first * n)
        source = np.arange(n)
        source[row:] -= 1
        kept = np.delete(np.arange(n), row)
        sequence = scale(m, m.distance[source]).take(kept)
        return replace(
            f, sequence=replace(sequence, came_from=None), rows=tuple(m.ids[k] for k in range(row + 1, n))
        )

    return spoil


def step(steps_mm: tuple[tuple[float, float, float], ...]) -> Callable[[Files, np.random.Generator], Files]:
    """(first share, last share, mm) of the sequence; what lasts to its end lasts in the fresh file too."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        values, n = f.sequence.distance.copy(), len(f.sequence)
        fresh = f.fresh
        rows: list[int] = []
        for first, last, mm in steps_mm:
            chosen = np.arange(int(first * n), int(last * n))
            values[chosen] += mm
            rows += chosen.tolist()
            if last >= 1.0:
                fresh = scale(fresh, fresh.distance + mm)
        return Files(
            f.robot, scale(f.sequence, values), fresh, tuple(f.sequence.ids[k] for k in sorted(set(rows)))
        )

    return spoil


def stuck(count: int, runs: int = 1) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        values = f.sequence.distance.copy()
        rows: list[int] = []
        for first in rng.choice(len(values) // count - 1, runs, replace=False) * count:
            values[first : first + count] = values[first]
            rows += list(range(int(first), int(first) + count))
        return replace(
            f, sequence=scale(f.sequence, values), rows=tuple(f.sequence.ids[k] for k in sorted(rows))
        )

    return spoil


def clipped(f: Files, rng: np.random.Generator) -> Files:
    limit = float(np.quantile(f.sequence.distance, 0.85))
    rows = np.flatnonzero(f.sequence.distance > limit)
    sequence = scale(f.sequence, np.minimum(f.sequence.distance, limit))
    return replace(f, sequence=sequence, rows=tuple(f.sequence.ids[k] for k in rows))


def pasted(count: int, *, whole: bool = False) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        n = len(f.sequence)
        first = int(rng.integers(0, n - 2 * count))
        copy = int(rng.integers(first + count, n - count + 1))
        source = np.arange(n)
        source[copy : copy + count] = np.arange(first, first + count)
        sequence = scale(f.sequence, f.sequence.distance[source])
        if whole:
            sequence = replace(sequence, theta=f.sequence.theta[source], came_from=None)
        return replace(f, sequence=sequence, rows=tuple(f.sequence.ids[k] for k in range(copy, copy + count)))

    return spoil


def robot_file(**changes: object) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, robot=replace(f.robot, **changes))  # type: ignore[arg-type]


def labels(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Files, np.random.Generator], Files]:
    return lambda f, rng: replace(f, sequence=replace(f.sequence, position=change(f.sequence.position)))


def approach(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Files, np.random.Generator], Files]:
    return in_both(lambda m: replace(m, approach=change(m.approach).astype(np.int8)))


def times(change: Callable[[Real], Real]) -> Callable[[Files, np.random.Generator], Files]:
    return in_both(lambda m: replace(m, t_s=change(m.t_s)))


def copied(share: float, *, shuffled: bool = False) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        count = int(share * len(f.sequence))
        rows = rng.permutation(len(f.sequence))[:count] if shuffled else np.arange(count)
        return replace(f, fresh=replace(f.sequence.take(rows), ids=tuple(range(1001, 1001 + count))))

    return spoil


def homed(by: tuple[float, float]) -> Callable[[Files, np.random.Generator], Files]:
    """The drive's count changes by so much before the fresh readings."""
    return in_fresh(add(by))


def written(*, sign: float = -1.0, between: bool = False) -> Callable[[Files, np.random.Generator], Files]:
    """Stands for zeros written: `by` is set from the fit, as the station would."""

    def spoil(f: Files, rng: np.random.Generator) -> Files:
        found = fit_readings(f.robot, f.sequence)
        by = sign * np.degrees(found.p[:2]) if found is not None else np.zeros(2)
        # feedback of the same pose counts from the new zero
        fresh = add((-float(by[0]), -float(by[1])))(f.fresh)
        if between:
            return replace(f, fresh=fresh)
        row = int(rng.integers(len(f.sequence) // 4, 3 * len(f.sequence) // 4))
        degrees = np.degrees(f.sequence.theta)
        degrees[row:] -= by
        return Files(f.robot, _angles(f.sequence, degrees), fresh, tuple(f.sequence.ids[row:]))

    return spoil


def glitched(count: int, mm: float) -> Callable[[Files, np.random.Generator], Files]:
    def spoil(f: Files, rng: np.random.Generator) -> Files:
        rows = np.sort(rng.choice(len(f.sequence), count, replace=False))
        values = f.sequence.distance.copy()
        values[rows] += rng.choice([-1.0, 1.0], count) * mm * rng.uniform(0.5, 2.0, count)
        return replace(f, sequence=scale(f.sequence, values), rows=tuple(f.sequence.ids[k] for k in rows))

    return spoil


def digit_exchanged(f: Files, rng: np.random.Generator) -> Files:
    """Two neighbouring digits of one reading."""
    row = int(rng.integers(len(f.sequence)))
    values = f.sequence.distance.copy()
    values[row] += 9.0 if values[row] < 50.0 else -9.0
    return replace(f, sequence=scale(f.sequence, values), rows=(f.sequence.ids[row],))
