"""Small charts as inline SVG: lines, points, bars, with axes, units and a legend.

Colours are Okabe and Ito's, which colour-blind readers can distinguish; lines differ in dash as well.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from markupsafe import Markup

from station.report.templates import environment
from station.report.words import ENGLISH, Words

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
DASHES = ("none", "6 3", "2 3", "8 3 2 3", "none", "6 3", "2 3")
WIDTH, HEIGHT = 560, 320
LEFT, RIGHT, TOP, BOTTOM = 64, 12, 12, 46
TICKS = 6
FEW = 60
"""Up to this number the points of a line are marked."""
LARGEST_DISC = 11.0
"""Radius, px."""


@dataclass(frozen=True)
class Series:
    """One line, set of points or set of bars; `low` and `high` draw a band or whiskers."""

    label: str
    x: Sequence[float]
    y: Sequence[float]
    low: Sequence[float] | None = None
    high: Sequence[float] | None = None
    points_only: bool = False
    """In a chart of lines: drawn as points only."""
    like: int | None = None
    """Number of the series whose colour and dash it shares, being a part of that one."""


@dataclass(frozen=True)
class _Axis:
    """Conversion from values to pixels."""

    first: float
    last: float
    start: float
    end: float
    log: bool = False
    words: Words = ENGLISH

    def at(self, value: float) -> float:
        a, b, v = (math.log10(x) for x in (self.first, self.last, value)) if self.log else (
            self.first, self.last, value
        )  # fmt: skip
        return round(self.start + (v - a) / (b - a) * (self.end - self.start), 2)

    @property
    def ticks(self) -> list[tuple[float, str]]:
        if self.log:
            decades = range(math.ceil(math.log10(self.first)), math.floor(math.log10(self.last)) + 1)
            return [(self.at(10.0**d), self.words.number(f"{10.0**d:g}")) for d in decades]
        step = _round_step((self.last - self.first) / TICKS)
        values = np.arange(math.ceil(self.first / step - 1e-9), math.floor(self.last / step + 1e-9) + 1)
        return [(self.at(v * step), self.words.number(f"{v * step:.10g}")) for v in values.tolist()]


def line(
    series: Sequence[Series], x_label: str, y_label: str, *, log_y: bool = False, words: Words = ENGLISH
) -> Markup:
    """Points joined in order, with a band if `low` and `high` are given."""
    return _chart("line", series, x_label, y_label, log_y, words)


def scatter(
    series: Sequence[Series],
    x_label: str,
    y_label: str,
    *,
    log_y: bool = False,
    x_names: Sequence[str] | None = None,
    words: Words = ENGLISH,
) -> Markup:
    """Points, with whiskers if `low` and `high` are given; x_names are labels at x = 0, 1, ..."""
    return _chart("scatter", series, x_label, y_label, log_y, words, x_names)


def place_map(
    x: Sequence[float], y: Sequence[float], value: Sequence[float], unit: str, *, words: Words = ENGLISH
) -> Markup:
    """Discs at positions of the workspace (mm): area is the size of a value, colour its sign."""
    x_axis = _Axis(*_range(x, 0.08), LEFT, WIDTH - RIGHT, words=words)
    y_axis = _Axis(*_range(y, 0.12), HEIGHT - BOTTOM, TOP, words=words)
    largest = max(map(abs, value)) or 1.0
    discs = [
        {
            "x": x_axis.at(a),
            "y": y_axis.at(b),
            "r": round(1.0 + LARGEST_DISC * math.sqrt(abs(v) / largest), 2),
            "colour": COLOURS[1] if v > 0 else COLOURS[0],
            "title": words.number(f"x {a:.0f}, y {b:.0f} mm: {v:.3g} {unit}"),
        }
        for a, b, v in zip(x, y, value, strict=True)
    ]
    legend = (
        Series(words.negative, (), ()),
        Series(words.positive.format(size=words.number(f"{largest:.3g} {unit}")), (), ()),
    )
    return _render(
        kind="map", discs=discs, x_ticks=x_axis.ticks, y_ticks=y_axis.ticks, x_label="x mm", y_label="y mm",
        labels=legend, words=words,
    )  # fmt: skip


def standalone(drawing: Markup) -> str:
    """A chart as a separate file, with the styles that a page would supply."""
    head = (
        '<svg xmlns="http://www.w3.org/2000/svg" '
        'style="font: 12px sans-serif; background: white; fill: #222; color: #222" '
    )
    style = (
        "<style>.grid { stroke: #8888; stroke-width: 0.5 } .axis { fill: none; stroke: #222 } "
        ".whisker { fill: none; stroke: #222 }</style>"
    )
    first, rest = str(drawing).strip().split(">", 1)
    return f"{first.replace('<svg ', head, 1)}>{style}{rest}\n"


def bar(categories: Sequence[str], series: Sequence[Series], y_label: str) -> Markup:
    """One group of bars for each category; the x of the series is ignored."""
    highest = max(max(s.high or s.y) for s in series)
    across = _Axis(0.0, len(categories), LEFT, WIDTH - RIGHT)
    up = _Axis(0.0, highest * 1.08 or 1.0, HEIGHT - BOTTOM, TOP)
    wide = 0.8 / len(series)
    bars = [
        {
            "x": across.at(k + 0.1 + i * wide),
            "width": round(across.at(wide) - across.at(0.0) - 1.0, 2),
            "y": up.at(s.y[k]),
            "low": up.at(s.low[k]) if s.low else None,
            "high": up.at(s.high[k]) if s.high else None,
            "colour": COLOURS[i % len(COLOURS)],
            "title": f"{s.label}, {name}: {s.y[k]:.4g}",
        }
        for i, s in enumerate(series)
        for k, name in enumerate(categories)
    ]
    names = [(across.at(k + 0.5), name) for k, name in enumerate(categories)]
    return _render(
        kind="bar", bars=bars, x_ticks=names, y_ticks=up.ticks, x_label="", y_label=y_label, labels=series
    )


def _chart(
    kind: Literal["line", "scatter"],
    series: Sequence[Series],
    x_label: str,
    y_label: str,
    log_y: bool,
    words: Words,
    x_names: Sequence[str] | None = None,
) -> Markup:
    xs = [v for s in series for v in s.x]
    ys = [v for s in series for part in (s.y, s.low or (), s.high or ()) for v in part]
    span = _range(xs, 0.0) if x_names is None else (-0.5, len(x_names) - 0.5)
    x_axis = _Axis(*span, LEFT + 6, WIDTH - RIGHT - 6, words=words)
    x_ticks = x_axis.ticks if x_names is None else [(x_axis.at(k), name) for k, name in enumerate(x_names)]
    y_axis = _Axis(*(_decades(ys) if log_y else _range(ys, 0.06)), HEIGHT - BOTTOM, TOP, log_y, words)
    drawn = []
    for i, s in enumerate(series):
        points = [(x_axis.at(x), y_axis.at(y)) for x, y in zip(s.x, s.y, strict=True)]
        band = None
        if s.low and s.high:
            band = [
                (x_axis.at(x), y_axis.at(low), y_axis.at(high))
                for x, low, high in zip(s.x, s.low, s.high, strict=True)
            ]
        drawn.append(
            {
                "points": points,
                "band": band,
                "colour": COLOURS[(i if s.like is None else s.like) % len(COLOURS)],
                "dash": DASHES[(i if s.like is None else s.like) % len(DASHES)],
                "joined": kind == "line" and not s.points_only,
                "dotted": kind == "scatter" or s.points_only or len(points) <= FEW,
                "titles": [
                    f"{s.label}: {words.numbers(f'{x:.5g}', f'{y:.5g}')}"
                    for x, y in zip(s.x, s.y, strict=True)
                ],
            }
        )
    return _render(
        kind=kind, drawn=drawn, x_ticks=x_ticks, y_ticks=y_axis.ticks, x_label=x_label, y_label=y_label,
        labels=series, words=words,
    )  # fmt: skip


def _render(labels: Sequence[Series], words: Words = ENGLISH, **parts: object) -> Markup:
    legend = [
        (s.label, COLOURS[i % len(COLOURS)], DASHES[i % len(DASHES)]) for i, s in enumerate(labels) if s.label
    ]
    x_label, y_label = parts["x_label"], parts["y_label"]
    frame = {
        "title": words.against.format(y=y_label, x=x_label) if x_label else y_label,
        "width": WIDTH,
        "height": HEIGHT + 20 * math.ceil(len(legend) / 2),
        "left": LEFT,
        "right": WIDTH - RIGHT,
        "top": TOP,
        "bottom": HEIGHT - BOTTOM,
    }
    # the template has escaped its values
    return Markup(environment().get_template("chart.svg.j2").render(legend=legend, **frame, **parts))  # noqa: S704


def _range(values: Sequence[float], margin: float) -> tuple[float, float]:
    low, high = min(values), max(values)
    if low == high:
        return low - 0.5, high + 0.5
    return low - margin * (high - low), high + margin * (high - low)


def _decades(values: Sequence[float]) -> tuple[float, float]:
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return 10.0**low, 10.0 ** max(high, low + 1)


def _round_step(rough: float) -> float:
    """The next 1, 2 or 5 times a power of ten above."""
    power = 10.0 ** math.floor(math.log10(rough))
    return next(m * power for m in (1.0, 2.0, 5.0, 10.0) if m * power >= rough * (1 - 1e-9))
