"""Gauge study: the gauge's share of the scatter of measured parts, by crossed analysis of variance.

Every operator measures every part several times.  Model: value = mean + part + operator + part x operator +
repeat, all random (AIAG, Measurement Systems Analysis, 4th edition, appendix A).  Negative components are set
to zero.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from station.errors import InputRefused
from station.quality.anova import (
    POOLED_ABOVE,
    AnovaRow,
    Interval,
    Sources,
    categories,
    deviations,
    drawn_expectations,
    intervals_of,
    mean_squares,
)
from station.records import Real, Record


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
    """Percentages of the total variation; their squares add to one."""
    ndc: int
    """Number of distinct categories that the gauge distinguishes among these parts."""
    interaction_p_value: float
    """p-value of the hypothesis that operators and parts do not interact."""
    interaction_pooled: bool
    """Whether operator x part is pooled with repeatability."""
    anova: tuple[AnovaRow, ...]
    intervals: dict[str, Interval]


def gauge_study(part: Sequence[str], operator: Sequence[str], value: Real) -> GaugeStudy:
    """Components of the scatter of `value` (N,), in its unit.

    :raises InputRefused: not every operator measured every part equally often, or too little was measured.
    """
    values = _crossed(part, operator, value)
    p, o, r = values.shape
    grand = values.mean()
    of_part, of_operator, of_cell = values.mean(axis=(1, 2)), values.mean(axis=(0, 2)), values.mean(axis=2)
    sources = Sources(
        squares={
            "part": o * r * float(np.sum((of_part - grand) ** 2)),
            "operator": p * r * float(np.sum((of_operator - grand) ** 2)),
            "part x operator": r
            * float(np.sum((of_cell - of_part[:, None] - of_operator[None, :] + grand) ** 2)),
            "repeatability": float(np.sum((values - of_cell[:, :, None]) ** 2)),
        },
        dof={
            "part": p - 1,
            "operator": o - 1,
            "part x operator": (p - 1) * (o - 1),
            "repeatability": p * o * (r - 1),
        },
        against={
            "part": "part x operator",
            "operator": "part x operator",
            "part x operator": "repeatability",
        },
    )
    p_between = sources.p_value("part x operator")
    if pooled := p_between > POOLED_ABOVE:
        sources.pool("part x operator")
    anova = sources.table()
    sd = deviations(*_components(values.shape, mean_squares(anova)))
    if not sd["tv"] > 0.0:
        raise InputRefused("All values are equal; a gauge study needs a finer resolution or other parts.")
    return GaugeStudy(
        parts=p,
        operators=o,
        trials=r,
        **{name: float(sd[name]) for name in ("ev", "av", "grr", "pv", "tv")},
        **{f"{name}_percent": float(sd[f"{name}_percent"]) for name in ("ev", "av", "grr", "pv")},
        ndc=categories(float(sd["pv"]), float(sd["grr"])),
        interaction_p_value=p_between,
        interaction_pooled=pooled,
        anova=anova,
        intervals=intervals_of(deviations(*_components(values.shape, drawn_expectations(anova)))),
    )


def _components(shape: tuple[int, ...], of: Mapping[str, Real]) -> tuple[Real, Real, Real]:
    """Variances of repeatability, operators and parts from mean squares; never negative."""
    p, o, r = shape
    repeat = of["repeatability"]
    between = of.get("part x operator", repeat)
    both = np.maximum((between - repeat) / r, 0.0)
    operator = np.maximum((of["operator"] - between) / (p * r), 0.0)
    part = np.maximum((of["part"] - between) / (o * r), 0.0)
    return repeat, operator + both, part


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
