"""Gauge study of a station: scatter of zero offsets by repeats, mounting, operators and robots.

Every operator mounts the mechanism several times at every robot, and with each mounting the station
calibrates several times.  Model: value = mean + robot + operator + robot x operator + mounting + repeat, all
random, with mountings nested within robot and operator; with one robot its terms are missing (Montgomery,
Design and Analysis of Experiments, chapter 14).  A calibration includes a mounting, so the equipment
variation is that of mounting and repeat together.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

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

SIXTH = 6.0
"""Number of standard deviations in a tolerance (AIAG)."""


class JointGauge(Record):
    """Gauge study of the zero offset of one joint; standard deviations in degrees."""

    joint: int
    mean_deg: float
    repeat: float
    """From one calibration to the next with the same mounting."""
    mounting: float
    """From one mounting of the mechanism to the next by the same operator."""
    ev: float
    """Equipment variation: repeat and mounting together."""
    av: float
    """Appraiser variation: operators and their interaction with robots."""
    grr: float
    """Gauge: `ev` and `av` together."""
    pv: float
    """Variation of robots: as measured, or the part that the tolerance leaves beside the gauge."""
    tv: float
    """Total variation: of the robots measured, or a sixth of the tolerance."""
    against: Literal["robots", "tolerance"]
    """Meaning of `tv`: with one robot the variation of robots is unknown."""
    ev_percent: float
    av_percent: float
    grr_percent: float
    pv_percent: float
    """Percentages of `tv`."""
    tolerance_percent: float
    """Six standard deviations of the gauge in percent of the tolerance."""
    ndc: int
    """Number of distinct categories."""
    interaction_p_value: float | None
    """p-value of the hypothesis that operators and robots do not interact; null with one robot."""
    anova: tuple[AnovaRow, ...]
    intervals: dict[str, Interval]
    """95 % intervals of the standard deviations and percentages."""


@dataclass(frozen=True)
class _Variances:
    repeat: Real
    mounting: Real
    operators: Real
    robots: Real


def joint_gauge(joint: int, values: Real, tolerance_deg: float) -> JointGauge:
    """The gauge study of values (robots, operators, mountings, repeats), deg; two or more except of robots.

    :param tolerance_deg: from the lower to the upper limit of a zero offset
    """
    sources = _sources(values)
    interaction = None
    if "robot x operator" in sources.squares:
        interaction = sources.p_value("robot x operator")
        if interaction > POOLED_ABOVE:
            sources.pool("robot x operator")
    anova = sources.table()
    sd = _figures(values.shape, _variances(values.shape, mean_squares(anova)), tolerance_deg)
    drawn = _figures(values.shape, _variances(values.shape, drawn_expectations(anova)), tolerance_deg)
    return JointGauge(
        joint=joint,
        mean_deg=float(values.mean()),
        **{name: float(value) for name, value in sd.items()},
        against="robots" if len(values) > 1 else "tolerance",
        ndc=categories(float(sd["pv"]), float(sd["grr"])),
        interaction_p_value=interaction,
        anova=anova,
        intervals=intervals_of(drawn),
    )


def gauge_sd(values: Real) -> Real:
    """(...,) sd of one calibration, from values (robots, operators, mountings, repeats, ...)."""
    shape, rest = values.shape[:4], values.shape[4:]
    found = []
    for one in np.moveaxis(values.reshape(*shape, -1), -1, 0):
        of = _variances(shape, mean_squares(_sources(one).table()))
        found.append(np.sqrt(of.repeat + of.mounting + of.operators))
    return np.array(found).reshape(rest)


def _sources(values: Real) -> Sources:
    """Sums of squares of a balanced study."""
    p, o, m, r = values.shape
    mounting, cell = values.mean(axis=3), values.mean(axis=(2, 3))
    robot, operator, grand = values.mean(axis=(1, 2, 3)), values.mean(axis=(0, 2, 3)), values.mean()
    squares = {
        "operator": p * m * r * float(np.sum((operator - grand) ** 2)),
        "mounting": r * float(np.sum((mounting - cell[:, :, None]) ** 2)),
        "repeat": float(np.sum((values - mounting[..., None]) ** 2)),
    }
    dof = {"operator": o - 1, "mounting": p * o * (m - 1), "repeat": p * o * m * (r - 1)}
    against = {"operator": "mounting", "mounting": "repeat"}
    if p == 1:
        return Sources(squares, dof, against)
    between = cell - robot[:, None] - operator[None, :] + grand
    squares = {
        "robot": o * m * r * float(np.sum((robot - grand) ** 2)),
        "operator": squares["operator"],
        "robot x operator": m * r * float(np.sum(between**2)),
        **squares,
    }
    dof |= {"robot": p - 1, "robot x operator": (p - 1) * (o - 1)}
    against |= {
        "robot": "robot x operator",
        "operator": "robot x operator",
        "robot x operator": "mounting",
    }
    return Sources(squares, dof, against)


def _variances(shape: tuple[int, ...], of: Mapping[str, Real]) -> _Variances:
    """Variances from mean squares; never negative."""
    p, o, m, r = shape
    mounting = np.maximum((of["mounting"] - of["repeat"]) / r, 0.0)
    between = of.get("robot x operator", of["mounting"])
    both = np.maximum((between - of["mounting"]) / (m * r), 0.0)
    operator = np.maximum((of["operator"] - between) / (p * m * r), 0.0)
    robot = np.maximum((of["robot"] - between) / (o * m * r), 0.0) if p > 1 else np.zeros_like(between)
    return _Variances(of["repeat"], mounting, operator + both, robot)


def _figures(shape: tuple[int, ...], of: _Variances, tolerance_deg: float) -> dict[str, Real]:
    """Standard deviations and percentages."""
    equipment = of.repeat + of.mounting
    gauge = equipment + of.operators
    sixth = tolerance_deg / SIXTH
    robots = of.robots if shape[0] > 1 else np.maximum(sixth**2 - gauge, 0.0)
    return {
        "repeat": np.sqrt(of.repeat),
        "mounting": np.sqrt(of.mounting),
        **deviations(equipment, of.operators, robots),
        "tolerance_percent": 100.0 * np.sqrt(gauge) / sixth,
    }
