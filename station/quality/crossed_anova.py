"""Gauge study: how much of the scatter of measured parts is the gauge, by crossed analysis of variance.

Every operator measures every part several times.  Model: value = mean + part + operator + part x operator +
repeat, all random (AIAG, Measurement Systems Analysis, 4th edition, appendix A).  Components that come out
negative are zero.  Intervals are generalised confidence intervals: each mean square over its expectation is
chi-square over its degrees of freedom (Burdick, Borror and Montgomery 2005, chapter 3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from station.errors import InputRefused
from station.records import Real, Record

POOLED_ABOVE = 0.25
"""p-value of the interaction above which it is taken for repeatability; high, so that a real one is kept."""
CATEGORIES = 1.41
"""Distinct categories per ratio of part variation to gauge variation (AIAG)."""
DRAWS = 100_000
"""Of the pivotal quantities; their quantiles are then good to a fraction of a percent of an interval."""
SEED = 20_05


class AnovaRow(Record):
    """One source of variation."""

    source: str
    dof: int
    sum_of_squares: float
    mean_square: float
    f: float | None
    p_value: float | None


class Interval(Record):
    """95 % confidence interval."""

    low: float
    high: float


class GaugeStudy(Record):
    """Standard deviations in the unit of the values."""

    parts: int
    operators: int
    trials: int
    ev: float
    """Equipment variation: repeatability."""
    av: float
    """Appraiser variation: operators and their interaction with parts."""
    grr: float
    """Gauge: `ev` and `av` together."""
    pv: float
    """Part variation."""
    tv: float
    """Total variation."""
    ev_percent: float
    av_percent: float
    grr_percent: float
    pv_percent: float
    """Of the total variation; their squares add to one."""
    ndc: int
    """Number of distinct categories that the gauge distinguishes among these parts."""
    interaction_p_value: float
    """Of the hypothesis that operators and parts do not interact."""
    interaction_pooled: bool
    """Whether operator x part is no more than repeatability."""
    anova: tuple[AnovaRow, ...]
    intervals: dict[str, Interval]


@dataclass(frozen=True)
class _MeanSquares:
    """Of a balanced crossed study with p parts, o operators and r trials."""

    shape: tuple[int, int, int]
    part: Real
    operator: Real
    interaction: Real | None
    """None: pooled."""
    repeat: Real

    def components(self) -> tuple[Real, Real, Real]:
        """Variances of repeatability, operators and parts; none is negative."""
        p, o, r = self.shape
        between = self.repeat if self.interaction is None else self.interaction
        both = np.maximum((between - self.repeat) / r, 0.0)
        operator = np.maximum((self.operator - between) / (p * r), 0.0)
        part = np.maximum((self.part - between) / (o * r), 0.0)
        return self.repeat, operator + both, part


def gauge_study(part: Sequence[str], operator: Sequence[str], value: Real) -> GaugeStudy:
    """Components of the scatter of `value` (N,), in its unit.

    :raises InputRefused: not every operator measured every part equally often, or too little was measured.
    """
    values = _crossed(part, operator, value)
    p, o, r = values.shape
    grand = values.mean()
    of_part, of_operator, of_cell = values.mean(axis=(1, 2)), values.mean(axis=(0, 2)), values.mean(axis=2)
    squares = {
        "part": o * r * float(np.sum((of_part - grand) ** 2)),
        "operator": p * r * float(np.sum((of_operator - grand) ** 2)),
        "part x operator": r
        * float(np.sum((of_cell - of_part[:, None] - of_operator[None, :] + grand) ** 2)),
        "repeatability": float(np.sum((values - of_cell[:, :, None]) ** 2)),
    }
    dof = {
        "part": p - 1,
        "operator": o - 1,
        "part x operator": (p - 1) * (o - 1),
        "repeatability": p * o * (r - 1),
    }
    between, repeat = ("part x operator", "repeatability")
    p_between = _p_value(squares, dof, between, repeat)
    pooled = p_between > POOLED_ABOVE
    if pooled:
        squares[repeat] += squares.pop(between)
        dof[repeat] += dof.pop(between)
    against = repeat if pooled else between
    tested = {"part": against, "operator": against, between: repeat}
    anova = tuple(
        AnovaRow(
            source=source,
            dof=dof[source],
            sum_of_squares=squares[source],
            mean_square=squares[source] / dof[source],
            f=_f(squares, dof, source, tested[source]) if source in tested else None,
            p_value=_p_value(squares, dof, source, tested[source]) if source in tested else None,
        )
        for source in squares
    )
    sd = _deviations(_mean_squares(values.shape, {row.source: np.array(row.mean_square) for row in anova}))
    if not sd["tv"] > 0.0:
        raise InputRefused("All values are equal; a gauge study needs a finer resolution or other parts.")
    rng = np.random.default_rng(SEED)
    drawn: dict[str, Real] = {
        row.source: row.mean_square * row.dof / rng.chisquare(row.dof, DRAWS) for row in anova
    }
    return GaugeStudy(
        parts=p,
        operators=o,
        trials=r,
        **{name: float(sd[name]) for name in ("ev", "av", "grr", "pv", "tv")},
        **{f"{name}_percent": float(sd[f"{name}_percent"]) for name in ("ev", "av", "grr", "pv")},
        ndc=int(CATEGORIES * sd["pv"] / sd["grr"]) if sd["grr"] > 0.0 else 0,
        interaction_p_value=p_between,
        interaction_pooled=pooled,
        anova=anova,
        intervals={
            name: Interval(low=float(low), high=float(high))
            for name, of in _deviations(_mean_squares(values.shape, drawn)).items()
            for low, high in (np.quantile(of, (0.025, 0.975)),)
        },
    )


def _mean_squares(shape: tuple[int, ...], of: dict[str, Real]) -> _MeanSquares:
    p, o, r = shape
    return _MeanSquares((p, o, r), of["part"], of["operator"], of.get("part x operator"), of["repeatability"])


def _deviations(of: _MeanSquares) -> dict[str, Real]:
    """Standard deviations, and percent of the total."""
    repeat, operators, parts = of.components()
    gauge = repeat + operators
    total = gauge + parts
    deviations = {"ev": repeat, "av": operators, "grr": gauge, "pv": parts}
    out = {name: np.sqrt(variance) for name, variance in {**deviations, "tv": total}.items()}
    with np.errstate(invalid="ignore"):
        return out | {f"{name}_percent": 100.0 * np.sqrt(v / total) for name, v in deviations.items()}


def _f(squares: dict[str, float], dof: dict[str, int], source: str, against: str) -> float | None:
    """None where the denominator has no scatter."""
    below = squares[against] / dof[against]
    return squares[source] / dof[source] / below if below > 0.0 else None


def _p_value(squares: dict[str, float], dof: dict[str, int], source: str, against: str) -> float:
    ratio = _f(squares, dof, source, against)
    if ratio is None:
        return 1.0 if squares[source] == 0.0 else 0.0
    return float(fdtrc(dof[source], dof[against], ratio))


def _crossed(part: Sequence[str], operator: Sequence[str], value: Real) -> Real:
    """(parts, operators, trials) in order of appearance.  :raises InputRefused:"""
    parts, operators = list(dict.fromkeys(part)), list(dict.fromkeys(operator))
    cells: dict[tuple[str, str], list[float]] = {(p, o): [] for p in parts for o in operators}
    for p, o, v in zip(part, operator, value, strict=True):
        cells[p, o].append(float(v))
    trials = len(cells[parts[0], operators[0]])
    for (p, o), measured in cells.items():
        if len(measured) != trials:
            raise InputRefused(
                f"Operator {o} measured part {p} {len(measured)} times, operator {operators[0]} part "
                f"{parts[0]} {trials} times; every operator must measure every part equally often."
            )
    for count, least, what in (
        (len(parts), 2, "parts"),
        (len(operators), 2, "operators"),
        (trials, 2, "trials"),
    ):
        if count < least:
            raise InputRefused(f"A crossed gauge study needs {least} {what} or more; there is {count}.")
    return np.array([[cells[p, o] for o in operators] for p in parts])
