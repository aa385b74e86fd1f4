"""Process control over finished runs: capability, run rules, charts, and outcomes."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence

import numpy as np

from station.quality.capability import Index, Limits, cpk, ppk
from station.quality.control_chart import D2, D4, Rule, ewma, ewma_limits, run_rules, sd_of_moving_range
from station.records import EffectPoint, Real, Record, TrendPoint

FEWEST = 3
"""Minimum number of values for the limits of a chart."""


class BrokenRule(Record):
    """One of Nelson's run rules, broken at a run."""

    name: Rule
    at: int
    """Number of the run that completes the pattern."""


class Figure(Record):
    """One quantity over many runs."""

    unit: str
    n: int
    mean: float | None = None
    sd: float | None = None
    """Standard deviation of all values."""
    low_limit: float | None = None
    high_limit: float | None = None
    """Upper limit of the value."""
    cpk: float | None = None
    """Capability from the scatter from one run to the next; null with fewer than three runs."""
    cpk_low: float | None = None
    cpk_high: float | None = None
    """95 % confidence limits."""
    ppk: float | None = None
    """Performance from the scatter of all values."""
    ppk_low: float | None = None
    ppk_high: float | None = None
    rules: tuple[BrokenRule, ...] = ()


class Ended(Record):
    """Number of runs with the same outcome."""

    outcome: str | None
    reason_code: str | None
    count: int


class Quality(Record):
    """Process control over the newest finished calibrations of the request."""

    runs: int
    dtheta1: Figure
    dtheta2: Figure
    position_error: Figure
    pareto: tuple[Ended, ...]
    """Most frequent first."""


class ChartLines(Record):
    """Lines of an individuals chart with its moving range and EWMA; null with fewer than three values."""

    centre: float | None = None
    sd: float | None = None
    """Standard deviation from one value to the next."""
    low: float | None = None
    high: float | None = None
    """Three standard deviations about the centre."""
    range_centre: float | None = None
    range_high: float | None = None
    at: tuple[int, ...] = ()
    """Runs that have a value."""
    ewma: tuple[float, ...] = ()
    ewma_low: tuple[float, ...] = ()
    ewma_high: tuple[float, ...] = ()
    rules: tuple[BrokenRule, ...] = ()


class EffectTrend(Record):
    """The size of one effect in the runs that found it."""

    effect: str
    joint: int | None
    part: str | None
    parameter: str
    unit: str
    values: tuple[float, ...]
    """Values of the runs `lines.at`."""
    lines: ChartLines


class Trend(Record):
    """Runs in order, with the charts of each quantity."""

    robot_serial: str | None
    """Null: all robots of the station."""
    items: tuple[TrendPoint, ...]
    """Calibrations, and between them applications, rollbacks and gauge studies."""
    dtheta1: ChartLines
    dtheta2: ChartLines
    position_error: ChartLines
    effects: tuple[EffectTrend, ...] = ()
    """Most frequent effect first."""


def _first(point: TrendPoint) -> float | None:
    return point.dtheta1_deg


def _second(point: TrendPoint) -> float | None:
    return point.dtheta2_deg


def _position(point: TrendPoint) -> float | None:
    return point.position_error_mm


def quality(points: Sequence[TrendPoint], *, zero_offset_deg: float, position_error_mm: float) -> Quality:
    """Figures of finished calibrations in order.

    :param zero_offset_deg: tolerance of a zero offset, to either side
    :param position_error_mm: limit of the bound of the position error
    """
    offsets = Limits(-zero_offset_deg, zero_offset_deg)
    ended = Counter((point.outcome, point.reason_code) for point in points)
    return Quality(
        runs=len(points),
        dtheta1=_figure(points, _first, "deg", offsets),
        dtheta2=_figure(points, _second, "deg", offsets),
        position_error=_figure(points, _position, "mm", Limits(None, position_error_mm)),
        pareto=tuple(
            Ended(outcome=outcome, reason_code=code, count=count)
            for (outcome, code), count in ended.most_common()
        ),
    )


def trend(
    robot_serial: str | None, points: Sequence[TrendPoint], effects: Sequence[EffectPoint] = ()
) -> Trend:
    """The points of one robot, or of all if there is no serial, with charts over those with measurements."""
    return Trend(
        robot_serial=robot_serial,
        items=tuple(points),
        dtheta1=_chart(points, _first),
        dtheta2=_chart(points, _second),
        position_error=_chart(points, _position),
        effects=_effects(effects),
    )


def _effects(points: Sequence[EffectPoint]) -> tuple[EffectTrend, ...]:
    found: dict[tuple[str, int | None, str | None, str, str], list[EffectPoint]] = {}
    for point in points:
        key = (point.effect, point.joint, point.part, point.parameter, point.unit)
        found.setdefault(key, []).append(point)
    trends = [
        EffectTrend(
            effect=effect,
            joint=joint,
            part=part,
            parameter=parameter,
            unit=unit,
            values=tuple(point.value for point in sizes),
            lines=_lines([point.run for point in sizes], np.array([point.value for point in sizes])),
        )
        for (effect, joint, part, parameter, unit), sizes in found.items()
    ]
    return tuple(sorted(trends, key=lambda one: -len(one.values)))


def _values(points: Sequence[TrendPoint], of: Callable[[TrendPoint], float | None]) -> tuple[list[int], Real]:
    """Runs of calibrations that have a value, and the values (N,)."""
    found = [
        (p.id, v) for p in points if p.kind == "calibrate" and (v := of(p)) is not None and math.isfinite(v)
    ]
    return [run for run, _ in found], np.array([value for _, value in found])


def _figure(
    points: Sequence[TrendPoint], of: Callable[[TrendPoint], float | None], unit: str, limits: Limits
) -> Figure:
    runs, values = _values(points, of)
    if not runs:
        return Figure(unit=unit, n=0, low_limit=limits.low, high_limit=limits.high)
    short, long = cpk(values, limits), ppk(values, limits)
    return Figure(
        unit=unit,
        n=len(runs),
        mean=float(values.mean()),
        sd=float(values.std(ddof=1)) if len(runs) > 1 else None,
        low_limit=limits.low,
        high_limit=limits.high,
        **_index("cpk", short),
        **_index("ppk", long),
        rules=_rules(runs, values),
    )


def _index(name: str, index: Index | None) -> dict[str, float]:
    return {} if index is None else {name: index.value, f"{name}_low": index.low, f"{name}_high": index.high}


def _rules(runs: Sequence[int], values: Real) -> tuple[BrokenRule, ...]:
    if len(runs) < FEWEST:
        return ()
    broken = run_rules(values, float(values.mean()), sd_of_moving_range(values))
    return tuple(
        BrokenRule(name=rule, at=runs[int(k)])
        for rule, where in broken.items()
        for k in np.flatnonzero(where)
    )


def _chart(points: Sequence[TrendPoint], of: Callable[[TrendPoint], float | None]) -> ChartLines:
    return _lines(*_values(points, of))


def _lines(runs: Sequence[int], values: Real) -> ChartLines:
    if len(runs) < FEWEST:
        return ChartLines(at=tuple(runs))
    centre, sd = float(values.mean()), sd_of_moving_range(values)
    mean_range = D2 * sd
    low, high = ewma_limits(len(runs), centre, sd)
    return ChartLines(
        centre=centre,
        sd=sd,
        low=centre - 3.0 * sd,
        high=centre + 3.0 * sd,
        range_centre=mean_range,
        range_high=D4 * mean_range,
        at=tuple(runs),
        ewma=tuple(ewma(values, centre).tolist()),
        ewma_low=tuple(low.tolist()),
        ewma_high=tuple(high.tolist()),
        rules=_rules(runs, values),
    )
