"""Named errors that depend on direction, tooth, period or moment: hardly any other error resembles them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from station.diagnosis.explanations.family import (
    Family,
    Hidden,
    Part,
    Quantities,
    alone,
    scaled,
    side_by_side,
    sizes,
)
from station.diagnosis.explanations.situation import Action, Situation
from station.diagnosis.explanations.thermal_families import thermal_families
from station.effects import amplitude_and_phase
from station.records import Quantity, Real

DEG = np.pi / 180.0
LOWEST_RIPPLE, HIGHEST_RIPPLE = 4.0, 80.0
SHORTEST_PERIOD_MM = 0.4
OVERSAMPLING = 2.0
"""Search steps per independent frequency."""
EDGE = 2
"""Minimum number of readings on either side of a step."""
LAST = (0, 2, 3)
"""Columns of `Situation.slider` that the last motion may be in."""
MOST_DOUBTFUL = 30
HEALING = (4, 8, 16, 32, 64)
"""Lengths of a step that reverts, in readings."""


def rough_families(s: Situation, lengths: Mapping[str, float], *, thermometer: bool) -> tuple[Family, ...]:
    """Families for the readings of `s`, nominal lengths by name (mm), and whether it has temperatures."""
    return (
        *(_backlash(i) for i in (1, 2)),
        _both_backlash(),
        *(_ripple(s, i) for i in (1, 2)),
        *(_slip(s, f"joint{i}", i) for i in (1, 2)),
        _both_slip(s),
        _slip(s, "reading", None),
        *(_healing(s, f"joint{i}", i) for i in (1, 2)),
        _healing(s, "reading", None),
        _scale_cyclic(s),
        _hysteresis(s),
        _drift(),
        *thermal_families(s, lengths, thermometer=thermometer),
    )


def _backlash(joint: int) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"joint{joint}", alone(-0.5 * s.approach[:, joint - 1]))]

    part = Part("backlash", joint, None, (0,), scaled("width_deg", 1.0 / DEG, "deg"))
    return Family("backlash", (part,), 0.5, sizes(3e-4 * DEG, 0.1 * DEG), ({},), actions, signed=True)


def _both_backlash() -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return side_by_side(
            ("joint1", "joint2"), [alone(-0.5 * s.approach[:, 0]), alone(-0.5 * s.approach[:, 1])]
        )

    parts = tuple(Part("backlash", i, None, (i - 1,), scaled("width_deg", 1.0 / DEG, "deg")) for i in (1, 2))
    range_ = sizes(3e-4 * DEG, 0.1 * DEG)
    return Family("backlash", parts, 0.2, range_, ({},), actions, one_sided=True)


def wave(angle: Real, per_turn: Sequence[float]) -> Real:
    """(V, K, 2) cosine and sine of multiples (V) of an angle (K,)."""
    turned = np.exp(1j * np.multiply.outer(np.asarray(per_turn), angle))
    return np.stack([turned.real, turned.imag], axis=2)


def waving(name: str, factor: float, unit: str, hidden_name: str, hidden_unit: str) -> Quantities:
    """Amplitude, phase and the searched period of a wave."""

    def quantities(hidden: Hidden, amplitudes: Real, covariance: Real) -> tuple[Quantity, ...]:
        size = amplitude_and_phase(name, unit, factor, amplitudes, covariance)
        return (*size, Quantity(hidden_name, hidden[hidden_name], 0.0, hidden_unit))

    return quantities


def _ripple(s: Situation, joint: int) -> Family:
    span = float(np.ptp(s.theta[:, joint - 1])) or 1.0
    step = 2.0 * np.pi / span / OVERSAMPLING
    hidden = tuple({"per_rev": float(n)} for n in np.arange(LOWEST_RIPPLE, HIGHEST_RIPPLE, step))

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"joint{joint}", wave(s.theta[:, joint - 1], [h["per_rev"] for h in hidden]))]

    def neighbours(h: Hidden, share: float) -> list[Hidden]:
        n = h["per_rev"]
        return [{"per_rev": max(n + sign * share * step, LOWEST_RIPPLE)} for sign in (-1.0, 1.0)]

    quantities = waving("amplitude_deg", 1.0 / DEG, "deg", "per_rev", "1/rev")
    part = Part("gear_cyclic", joint, None, (0, 1), quantities)
    return Family(
        "ripple", (part,), 0.5, sizes(3e-4 * DEG, 0.2 * DEG), hidden, actions,
        neighbours=neighbours, repeats=True,
    )  # fmt: skip


def stepped(t_s: Real, hidden: Sequence[Hidden]) -> Real:
    """(V, K, 1) one from a moment on, until another where given."""
    begin = np.array([h["from_s"] for h in hidden])[:, None]
    end = np.array([h.get("until_s", np.inf) for h in hidden])[:, None]
    return ((t_s >= begin) & (t_s < end)).astype(float)[:, :, None]


def beginnings(s: Situation) -> tuple[Hidden, ...]:
    """Every moment at which something may have moved permanently."""
    t = np.sort(s.t_s)
    return tuple({"from_s": float(v)} for v in t[EDGE : len(t) - EDGE + 1])


def _step_size(joint: int | None, t: Callable[[Hidden], tuple[Quantity, ...]]) -> Quantities:
    name, factor, unit = ("step_mm", 1.0, "mm") if joint is None else ("step_deg", 1.0 / DEG, "deg")
    size = scaled(name, factor, unit)
    return lambda hidden, a, C: (*size(hidden, a, C), *t(hidden))


def _when(hidden: Hidden) -> tuple[Quantity, ...]:
    return tuple(Quantity(name, value, 0.0, "s") for name, value in hidden.items())


def _slip(s: Situation, target: str, joint: int | None) -> Family:
    return replace(_step("step", 1.0 if joint is None else 0.5, target, joint, beginnings(s)), repeats=True)


def _both_slip(s: Situation) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        step = stepped(s.t_s, hidden)
        return side_by_side(("joint1", "joint2"), (step, step))

    parts = tuple(Part("count_slip", i, None, (i - 1,), _step_size(i, _when)) for i in (1, 2))
    return Family("step", parts, 0.2, sizes(5e-4 * DEG, 4.0 * DEG), beginnings(s), actions)


def _healing(s: Situation, target: str, joint: int | None) -> Family:
    t = np.sort(s.t_s)
    every = max(2, len(t) // 40)
    hidden = tuple(
        {"from_s": float(t[k]), "until_s": float(t[k + length])}
        for length in HEALING
        for k in range(EDGE, len(t) - length - EDGE, every if length > HEALING[0] else 2)
    )

    def neighbours(h: Hidden, share: float) -> list[Hidden]:
        begin, end = (int(k) for k in np.searchsorted(t, (h["from_s"], h["until_s"])))
        later, longer = max(1, round(share * every)), max(1, round(share * (end - begin) / 2))
        moved = [(begin + k * later, end + n * longer) for k in (-1, 0, 1) for n in (-1, 0, 1)]
        moved += [(begin + k, end + k) for k in (-later, later)]
        return [
            {"from_s": float(t[b]), "until_s": float(t[e])}
            for b, e in moved
            if EDGE <= b < e - 1 and e < len(t)
        ]

    return _step("healing step", 0.3 if joint is None else 0.15, target, joint, hidden, neighbours)


def _step(
    name: str,
    weight: float,
    target: str,
    joint: int | None,
    hidden: tuple[Hidden, ...],
    neighbours: Callable[[Hidden, float], list[Hidden]] | None = None,
) -> Family:
    """A step of the reading (no joint) or of one joint's counts, at the moments that are tried."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(target, stepped(s.t_s, hidden))]

    effect, part = ("reading_step", "reading") if joint is None else ("count_slip", None)
    return Family(
        name,
        (Part(effect, joint, part, (0,), _step_size(joint, _when)),),
        weight,
        sizes(0.002, 5.0) if joint is None else sizes(5e-4 * DEG, 2.0 * DEG),
        hidden,
        actions,
        neighbours=neighbours,
    )


def _scale_cyclic(s: Situation) -> Family:
    span = float(np.ptp(s.travel)) or 1.0
    frequency = np.arange(2.0 / span, 1.0 / SHORTEST_PERIOD_MM, 1.0 / span / OVERSAMPLING)
    hidden = tuple({"period_mm": float(1.0 / f)} for f in frequency)

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action("reading", wave(s.travel, [2.0 * np.pi / h["period_mm"] for h in hidden]))]

    def neighbours(h: Hidden, share: float) -> list[Hidden]:
        f, step = 1.0 / h["period_mm"], share / span / OVERSAMPLING
        return [{"period_mm": 1.0 / max(f + sign * step, 1.0 / span)} for sign in (-1.0, 1.0)]

    part = Part("scale_cyclic", None, None, (0, 1), waving("amplitude_mm", 1.0, "mm", "period_mm", "mm"))
    return Family(
        "scale ripple", (part,), 1.0, sizes(5e-4, 0.3), hidden, actions, neighbours=neighbours, repeats=True
    )


def _hysteresis(s: Situation) -> Family:
    """The reading lags the slider, by last motion or by net travel where these differ.

    If one joint arrives last, the last motion may be that of either joint alone. Where the slider moved too
    little, or its motion is unknown, it may stand anywhere in between: those readings have an amplitude of
    their own, as large as the width.
    """
    moments = s.t_s[np.any(s.slider[:, LAST] == 0.0, axis=1)][:MOST_DOUBTFUL]

    def shape(s: Situation, last: Real) -> Real:
        net = s.slider[:, 1]
        own = s.t_s[:, None] == moments[None]
        own &= (last == 0.0)[:, None]
        turned = np.where((last != net) & (last != 0.0), last, 0.0)
        sure = np.where(own.any(axis=1) | (turned != 0.0), 0.0, net)
        return 0.5 * np.column_stack([-sure, -turned, own])

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action("reading", np.stack([shape(s, s.slider[:, int(h["last"])]) for h in hidden]))]

    part = Part("scale_hysteresis", None, None, (0,), scaled("width_mm", 1.0, "mm"))
    hidden = tuple({"last": float(column)} for column in LAST)
    return Family("hysteresis", (part,), 1.0, sizes(1e-3, 0.3), hidden, actions)


def _drift() -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action("reading", alone(s.t_s / 3600.0))]

    part = Part("drift", None, None, (0,), scaled("mm_per_hour", 1.0, "mm/h"))
    return Family("drift", (part,), 1.0, sizes(0.03, 20.0), ({},), actions)
