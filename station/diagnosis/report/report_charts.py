"""The charts of the report: learned curves, and the residual before and after."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from markupsafe import Markup

from station.diagnosis.report.findings import ResidualView
from station.diagnosis.report.joint_curves import Curve
from station.diagnosis.report.wording import ENGLISH, Wording
from station.records import Measurements, Real
from station.report import Chart, Series, line, place_map, scatter

UM = "µm"
MICROMETRES = 1e3
MOST_POINTS = 600
MOST_PLACES = 300
GAP_DEG = 1.0


def curve_chart(curve: Curve, wording: Wording = ENGLISH) -> Markup:
    """One joint's curve."""
    low, high = (curve.value_deg + sign * 2.0 * curve.sd_deg for sign in (-1.0, 1.0))
    gaps = np.flatnonzero(np.diff(curve.angle_deg) > GAP_DEG) + 1
    stretches = [
        _milli(*(values[part] for values in (curve.angle_deg, curve.value_deg, low, high)))
        for part in np.split(np.arange(len(curve.angle_deg)), gaps)
    ]
    measured = _milli(curve.binned_angle_deg, curve.binned_deg)
    return line(
        [
            replace(stretches[0], label=wording.say("learned")),
            replace(measured, label=wording.say("measured"), points_only=True),
            *(replace(stretch, like=0) for stretch in stretches[1:]),
        ],
        wording.say("theta_axis", joint=curve.joint),
        wording.say("error_axis"),
        words=wording.of_charts,
    )


def _milli(angle: Real, value: Real, low: Real | None = None, high: Real | None = None) -> Series:
    return Series(
        "",
        angle.tolist(),
        (1e3 * value).tolist(),
        None if low is None else (1e3 * low).tolist(),
        None if high is None else (1e3 * high).tolist(),
    )


def residual_charts(m: Measurements, view: ResidualView, added: bool, wording: Wording) -> Iterator[Chart]:
    """Pairs against order, time, angles, travel, approach and position; single if nothing was added."""
    say, words = wording.say, wording.of_charts
    was, left = view.before_mm * MICROMETRES, view.after_mm * MICROMETRES
    for name, along in _by_number(m, view, wording):
        yield from _pair(name, along, was, left, added, wording)
    for i in range(m.joints):
        approach = view.approach[:, i]
        if np.any(approach):
            names = (say("from_above"), say("from_unknown"), say("from_below"))
            # side by side, so that points of one kind do not cover each other
            along = approach + 1.0 + np.linspace(-0.3, 0.3, len(approach))
            yield from _pair(say("approach_axis", joint=i + 1), along, was, left, added, wording, names)
    at = view.place_mm
    first = np.unique(m.position, return_index=True)[1]
    for values, caption in ((was, "before_places"), (left, "after_places")):
        mean = np.bincount(m.position, values) / np.maximum(np.bincount(m.position), 1)
        places = mean[m.position[first]]
        every = -(-len(first) // MOST_PLACES)
        x, y, value = (v[::every].tolist() for v in (at[first, 0], at[first, 1], places))
        yield Chart(place_map(x, y, value, UM, words=words), say(caption))
        if not added:
            break


def _by_number(m: Measurements, view: ResidualView, wording: Wording) -> Iterator[tuple[str, Real]]:
    say = wording.say
    yield say("order_axis"), np.arange(1.0, len(view.before_mm) + 1.0)
    yield say("time_axis"), m.t_s
    for i in range(m.joints):
        if i + 1 in m.sliding:
            yield say("sliding_axis", joint=i + 1), view.theta[:, i] * 1e3
        else:
            yield say("theta_axis", joint=i + 1), np.degrees(view.theta[:, i])
    if np.ptp(view.travel_mm) > 0:
        yield say("travel_axis"), view.travel_mm
    if view.temperature_rise_k is not None:
        yield say("temperature_axis"), view.temperature_rise_k


def _pair(
    name: str,
    along: Real,
    was: Real,
    left: Real,
    added: bool,
    wording: Wording,
    x_names: Sequence[str] | None = None,
) -> Iterator[Chart]:
    """The chart before, and the chart after where there is one."""
    say, words = wording.say, wording.of_charts
    measured = [_points(say("less_base"), along, was)]
    if added:
        measured.append(_points(say("accounted_for"), along, was - left))
    drawing = scatter(measured, name, say("residual_axis"), x_names=x_names, words=words)
    yield Chart(drawing, say("before_by", axis=name))
    if added:
        rest = [_points(say("left"), along, left)]
        drawing = scatter(rest, name, say("rest_axis"), x_names=x_names, words=words)
        yield Chart(drawing, say("after_by", axis=name))


def _points(label: str, x: Real, y: Real) -> Series:
    """At most as many points as are distinguishable on the page, evenly spread over the log."""
    every = -(-len(x) // MOST_POINTS)
    return Series(label, x[::every].tolist(), y[::every].tolist())
