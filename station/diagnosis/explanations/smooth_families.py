"""Named errors that are smooth over the workspace, alone and as natural pairs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
from station.diagnosis.explanations.rough_families import DEG, wave
from station.diagnosis.explanations.situation import Action, Situation
from station.effects import amplitude_and_phase
from station.records import Quantity, Real

EVEN, UNEVEN, SELDOM = (0, 1), (2, 3, 4, 5), 0.1
"""Forms of sag in proportion to the load and of others, and the prior weight of the latter."""
SAME, OWN = 1.0, 0.3
"""Prior weight of a natural pair with one size for both sides, and with separate sizes."""
Shape = Callable[[Situation, int, Sequence[Hidden]], Real]
"""Joint 1 or 2 -> (V, K, q)."""


def smooth_families(s: Situation) -> tuple[Family, ...]:
    """Families for the readings of `s`."""
    sag, uneven = (tuple({"of": float(form)} for form in forms) for forms in (EVEN, UNEVEN))
    turned = (0.002 * DEG, 0.4 * DEG)
    gain = scaled("ppm", 1e6, "ppm")
    sags = scaled("deg_at_horizontal", 1.0 / DEG, "deg")
    return (
        *_at_joints("encoder_eccentricity", _once, ({},), (0.003 * DEG, 0.5 * DEG), eccentric, (0, 1)),
        *_at_joints("transmission_gain", _gain, ({},), (5e-5, 1.5e-2), gain, (0,)),
        *_at_joints("compliance", _sag, sag, turned, sags, (0,), signed=True),
        *(
            replace(family, kind="uneven compliance", weight=family.weight * SELDOM)
            for family in _at_joints("compliance", _sag, uneven, turned, sags, (0,), signed=True)[:3]
        ),
        *_lengths("L"),
        *_lengths("l"),
        *(_clearance(i) for i in (1, 2)),
        _reading("scale_gain", lambda s, h: alone(s.travel * 1e-6), ({},), (50.0, 1.5e4), "ppm", 1.0, "ppm"),
        replace(
            _reading("scale_bow", _bow, _bow_centres(s), (2e-3, 0.8), "mm_at_100_mm", 1.0, "mm"),
            neighbours=_nearby_centres,
        ),
    )


def eccentric(hidden: Hidden, amplitudes: Real, covariance: Real) -> tuple[Quantity, ...]:
    """Amplitude and phase of an error once per turn."""
    return amplitude_and_phase("amplitude_deg", "deg", 1.0 / DEG, amplitudes, covariance)


def _once(s: Situation, joint: int, hidden: Sequence[Hidden]) -> Real:
    return wave(s.theta[:, joint - 1], [1.0])


def _gain(s: Situation, joint: int, hidden: Sequence[Hidden]) -> Real:
    return alone(s.drive_angle[:, joint - 1])


def _sag(s: Situation, joint: int, hidden: Sequence[Hidden]) -> Real:
    """Wind-up under the arm's own weight, or under the platform's, held through the distal links.

    The last four describe a drive train whose stiffness changes with the load.
    """
    i = joint - 1
    load = np.cos(s.theta[:, i])
    platform = s.force[:, i] * np.sin(s.phi[:, i] - s.theta[:, i])
    stiffer = (-(1.0 + k) * load / (1.0 + k * np.abs(load)) for k in (1.0, 4.0))
    uneven = (-(load**3), -load * np.abs(load), *stiffer)
    shapes = np.stack([-load, platform, *uneven])[[int(h["of"]) for h in hidden]][:, :, None]
    if s.payload_kg is not None:
        shapes = shapes * (1.0 + s.payload_kg[:, None])
    return np.asarray(shapes)


def _at_joints(
    effect: str,
    shape: Shape,
    hidden: tuple[Hidden, ...],
    range_: tuple[float, float],
    quantities: Quantities,
    own: tuple[int, ...],
    *,
    signed: bool = False,
) -> tuple[Family, ...]:
    """The effect at joint 1, at joint 2, at both with one size, and at both with separate sizes."""
    width = len(own)

    def single(joint: int) -> Family:
        def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
            return [Action(f"joint{joint}", shape(s, joint, hidden))]

        part = Part(effect, joint, None, own, quantities)
        return Family(effect, (part,), 0.5, sizes(*range_), hidden, actions, signed=signed)

    def same(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"joint{i}", shape(s, i, hidden)) for i in (1, 2)]

    def both(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return side_by_side(("joint1", "joint2"), [shape(s, i, hidden) for i in (1, 2)])

    alike = tuple(Part(effect, i, None, own, quantities) for i in (1, 2))
    each = tuple(Part(effect, i, None, tuple(k + width * (i - 1) for k in own), quantities) for i in (1, 2))
    pair = Family(effect, each, OWN, sizes(*range_), hidden, both, one_sided=signed)
    if width > 1:
        return (single(1), single(2), pair)
    return (
        single(1),
        single(2),
        Family(effect, alike, SAME, sizes(*range_), hidden, same, signed=signed),
        pair,
    )


def _lengths(kind: str) -> tuple[Family, ...]:
    range_ = sizes(0.05, 8.0)

    def part(i: int, at: int) -> Part:
        return Part("link_length", i, f"{kind}{i}", (at,), scaled(f"{kind}{i}", 1.0, "mm"))

    def single(i: int) -> Family:
        def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
            return [Action(f"{kind}{i}", alone(np.ones(len(s))))]

        return Family("length", (part(i, 0),), 0.5, range_, ({},), actions)

    def same(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"{kind}{i}", alone(np.ones(len(s)))) for i in (1, 2)]

    def both(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        one = alone(np.ones(len(s)))
        return side_by_side((f"{kind}1", f"{kind}2"), (one, one))

    return (
        single(1),
        single(2),
        Family("length", (part(1, 0), part(2, 0)), SAME, range_, ({},), same),
        Family("length", (part(1, 0), part(2, 1)), OWN, range_, ({},), both),
    )


def _clearance(joint: int) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"l{joint}", alone(np.sign(s.force[:, joint - 1])))]

    part = Part("joint_clearance", joint, None, (0,), scaled("mm", 1.0, "mm"))
    return Family("clearance", (part,), 0.25, sizes(0.02, 0.5), ({},), actions, signed=True)


def _reading(
    effect: str,
    shape: Callable[[Situation, Sequence[Hidden]], Real],
    hidden: tuple[Hidden, ...],
    range_: tuple[float, float],
    name: str,
    factor: float,
    unit: str,
) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action("reading", shape(s, hidden))]

    part = Part(effect, None, None, (0,), scaled(name, factor, unit))
    return Family(effect, (part,), 1.0, sizes(*range_), hidden, actions)


def _bow_centres(s: Situation) -> tuple[Hidden, ...]:
    """Centres across the visited travel, and the head's own zero."""
    low, high = float(s.travel.min()), float(s.travel.max())
    return ({"centre_mm": 0.0}, *({"centre_mm": float(v)} for v in np.linspace(low, high, 7)))


def _nearby_centres(h: Hidden, share: float) -> list[Hidden]:
    return [{"centre_mm": h["centre_mm"] + sign * 15.0 * share} for sign in (-1.0, 1.0)]


def _bow(s: Situation, hidden: Sequence[Hidden]) -> Real:
    centre = np.array([h["centre_mm"] for h in hidden])[:, None]
    return np.asarray(((s.travel - centre) / 100.0) ** 2)[:, :, None]
