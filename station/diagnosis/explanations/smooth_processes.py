"""Unstructured unnamed errors: Gaussian processes over angle, travel, position, time, approach x position.

A process over x with length scale h is a weighted sum of shapes k(x, z) K^-1/2 at inducing points z
(Nystrom): independent amplitudes of unit variance then have its covariance.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from station.diagnosis.explanations.family import Family, Hidden, Shapes, sizes
from station.diagnosis.explanations.rough_families import DEG
from station.diagnosis.explanations.situation import Action, Situation
from station.diagnosis.explanations.structured_families import unnamed
from station.records import Real

NEGLIGIBLE = 3e-4
"""Eigenvalues below this share of the largest are left out."""
MOST_SHAPES = 16


def processes(s: Situation) -> tuple[Family, ...]:
    """Processes for the readings of `s`."""
    angle, mm = sizes(0.001 * DEG, 0.3 * DEG), sizes(0.001, 0.5)
    return (
        *(_stiff(s, joint) for joint in (1, 2)),
        *(
            _process(
                f"joint{joint}", "smooth angle", f"joint{joint}", weight, angle, _over_angle(s, joint, h)
            )
            for joint in (1, 2)
            for h, weight in ((1.0, 0.25), (0.5, 0.25), (0.25, 0.15), (0.12, 0.1))
        ),
        *(
            _process(
                f"joint{joint}", "smooth other", f"joint{3 - joint}", 0.1, angle, _over_angle(s, 3 - joint, h)
            )
            for joint in (1, 2)
            for h in (1.0, 0.5)
        ),
        *(
            _process(f"joint{joint}", "smooth joint place", "place", 0.2, angle, _over_place(1.2, (4, 3)))
            for joint in (1, 2)
        ),
        *(
            _process("reading", "smooth travel", "reading", weight, mm, _over_travel(s, h))
            for h, weight in ((1.0, 0.2), (0.4, 0.3), (0.15, 0.3), (0.08, 0.2))
        ),
        *(
            _process("reading", "smooth place", "place", 0.3, mm, _over_place(h, n))
            for h, n in ((1.2, (4, 3)), (0.5, (8, 3)))
        ),
        *(
            _process("reading", "smooth time", "time", weight, mm, _over_time(s, h))
            for h, weight in ((0.5, 0.25), (0.2, 0.25), (0.07, 0.25))
        ),
        _process("reading", "wandering", "time", 0.5, mm, _wandering(s)),
        *(
            _process(f"joint{joint}", "wandering joint", "time", 0.3, angle, _wandering(s))
            for joint in (1, 2)
        ),
        *(
            _process(f"joint{joint}", "approach by place", "approach", 0.4, angle, _approach_by_place(joint))
            for joint in (1, 2)
        ),
        _process("reading", "slider by place", "approach", 0.3, mm, _slider_by_place()),
        _process("reading", "slider by travel", "approach", 0.3, mm, _slider_by_travel(s)),
        _patch("patch", "place", None, 0.5),
        *(_patch("patch by approach", "approach", i, 0.25) for i in (0, 1)),
        _patch("patch by slider", "approach", 2, 0.4),
        _bump(s),
    )


def _process(target: str, kind: str, depends_on: str, weight: float, range_: Real, shapes: Shapes) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(target, shapes(s)[None])]

    return unnamed(kind, depends_on, weight, range_, ({},), actions)


def _induced(points: Real, scale: Real) -> Callable[[Real], Real]:
    """x (K, d) -> (K, q) shapes of a process with length scales `scale` (d,) from inducing points (M, d)."""
    z = points / scale
    values, vectors = np.linalg.eigh(_kernel(z, z))
    kept = values > max(NEGLIGIBLE * values[-1], np.sort(values)[-min(MOST_SHAPES, len(values))] * 0.999)
    root = vectors[:, kept] / np.sqrt(values[kept])
    return lambda x: _kernel(x / scale, z) @ root


def _kernel(a: Real, b: Real) -> Real:
    square = np.sum(a**2, axis=1)[:, None] + np.sum(b**2, axis=1) - 2.0 * a @ b.T
    return np.asarray(np.exp(-0.5 * square))


def _line(low: float, high: float, h: float) -> Callable[[Real], Real]:
    """A process of one variable; the length scale is `h` half-ranges."""
    half = (high - low) / 2.0 or 1.0
    count = int(np.clip(np.ceil(3.0 / h) + 2, 4, 20))
    induced = _induced(np.linspace(low, high, count)[:, None], np.array([h * half]))
    return lambda x: induced(x[:, None])


def _over_angle(s: Situation, joint: int, h: float) -> Shapes:
    theta = s.theta[:, joint - 1]
    line = _line(float(theta.min()), float(theta.max()), 2.0 * h)
    return lambda s: line(s.theta[:, joint - 1])


def _over_travel(s: Situation, h: float) -> Shapes:
    line = _line(float(s.travel.min()), float(s.travel.max()), 2.0 * h)
    return lambda s: line(s.travel)


def _over_time(s: Situation, h: float) -> Shapes:
    line = _line(float(s.t_s.min()), float(s.t_s.max()), 2.0 * h)
    return lambda s: line(s.t_s)


def _wandering(s: Situation) -> Shapes:
    """A random walk in time, by the largest waves of its Karhunen-Loeve expansion."""
    low, span = float(s.t_s.min()), float(np.ptp(s.t_s)) or 1.0
    rate = (np.arange(MOST_SHAPES) + 0.5) * np.pi
    return lambda s: np.sqrt(2.0) * np.sin(rate * ((s.t_s - low) / span)[:, None]) / rate


def wanderings(s: Situation) -> tuple[Family, ...]:
    """An independent step at every reading: for changes so fast that no smooth curve follows them.

    It has as many amplitudes as readings; `weighing` uses it only where everything else leaves more than
    noise.
    """
    moments = np.sort(s.t_s)[1:]

    def made(target: str, range_: Real) -> Family:
        def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
            return [Action(target, (s.t_s[:, None] >= moments).astype(float)[None])]

        kind = "wandering reading" if target == "reading" else "wandering joint"
        return replace(unnamed(kind, "time", 0.3, range_, ({},), actions), width=len(moments))

    angle = sizes(3e-5 * DEG, 0.01 * DEG)
    return made("reading", sizes(3e-4, 0.05)), made("joint1", angle), made("joint2", angle)


@cache
def _over_place(h: float, count: tuple[int, int]) -> Shapes:
    induced = _induced(_lattice(count), np.array([h, 2.0 * h]))
    return lambda s: induced(s.place)


def _lattice(count: tuple[int, int]) -> Real:
    u, v = np.meshgrid(np.linspace(-1, 1, count[0]), np.linspace(-1, 1, count[1]), indexing="ij")
    return np.column_stack([u.ravel(), v.ravel()])


@cache
def _approach_by_place(joint: int) -> Shapes:
    induced = _induced(_lattice((5, 2)), np.array([0.7, 1.4]))
    return lambda s: induced(s.place) * s.approach[:, [joint - 1]]


@cache
def _slider_by_place() -> Shapes:
    induced = _induced(_lattice((5, 2)), np.array([0.7, 1.4]))
    return lambda s: induced(s.place) * s.slider[:, :1]


def _slider_by_travel(s: Situation) -> Shapes:
    line = _line(float(s.travel.min()), float(s.travel.max()), 0.6)
    return lambda s: line(s.travel) * s.slider[:, :1]


def _stiff(s: Situation, joint: int) -> Family:
    """Curves too stiff for any length scale: powers of the angle, wind-up that grows towards one end.

    Each also multiplied by the angle, since the true power or rate lies between those that are tried.
    """
    theta = s.theta[:, joint - 1]
    middle, half = float(theta.max() + theta.min()) / 2.0, float(np.ptp(theta)) / 2.0 or 1.0
    hidden = (
        *({"power": float(n)} for n in (2, 3, 4, 5)),
        *({"from_zero": float(n)} for n in (2, 3, 4)),
        *({"rate": rate} for rate in (-8.0, -4.0, -2.0, -1.0, 1.0, 2.0, 4.0, 8.0)),
    )

    def one(x: Real, s: Situation, h: Hidden) -> Real:
        if "power" in h:
            return np.asarray(x ** int(h["power"]))
        if "from_zero" in h:
            turned = s.drive_angle[:, joint - 1]
            return np.asarray(
                np.sign(turned) ** (int(h["from_zero"]) + 1) * np.abs(turned / half) ** h["from_zero"]
            )
        return np.asarray(np.exp(h["rate"] * x - abs(h["rate"])))

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        x = (s.theta[:, joint - 1] - middle) / half
        curves = np.stack([one(x, s, h) for h in hidden])
        return [Action(f"joint{joint}", np.stack([curves, curves * x], axis=2))]

    return unnamed("stiff curve", f"joint{joint}", 0.5, sizes(0.002 * DEG, 2.0 * DEG), hidden, actions)


def _patch(kind: str, depends_on: str, by: int | None, weight: float) -> Family:
    """A patch of the workspace, by the sense of joint 1 (0), joint 2 (1), the slider (2) or none."""
    hidden = tuple(
        {"u": float(u), "v": float(v), "radius": radius}
        for radius in (0.12, 0.22)
        for u in np.linspace(-1.0, 1.0, 11)
        for v in np.linspace(-1.0, 1.0, 5)
    )

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        at = np.array([[h["u"], h["v"], h["radius"]] for h in hidden])
        du = s.place[:, 0] - at[:, :1]
        dv = (s.place[:, 1] - at[:, 1:2]) * 0.31
        spot = np.exp(-0.5 * (du**2 + dv**2) / at[:, 2:] ** 2)
        if by is not None:
            spot = spot * (s.slider[:, 0] if by == 2 else s.approach[:, by])
        return [Action("reading", spot[:, :, None])]

    def neighbours(h: Hidden, share: float) -> list[Hidden]:
        moved = [
            {"u": h["u"] + a * 0.2 * share, "v": h["v"] + b * 0.5 * share, "radius": h["radius"]}
            for a, b in ((-1, 0), (1, 0), (0, -1), (0, 1))
        ]
        return [*moved, *({**h, "radius": h["radius"] * factor} for factor in (0.5**share, 2.0**share))]

    return replace(
        unnamed(kind, depends_on, weight, sizes(0.003, 1.0), hidden, actions), neighbours=neighbours
    )


def _bump(s: Situation) -> Family:
    """A short section of the travel."""
    low, high = float(s.travel.min()), float(s.travel.max())
    hidden = tuple(
        {"at_mm": float(at), "width_mm": width}
        for width in (3.0, 6.0, 12.0)
        for at in np.arange(low, high, width)
    )

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        at = np.array([[h["at_mm"], h["width_mm"]] for h in hidden])
        return [Action("reading", np.exp(-0.5 * ((s.travel - at[:, :1]) / at[:, 1:]) ** 2)[:, :, None])]

    def neighbours(h: Hidden, share: float) -> list[Hidden]:
        at, width = h["at_mm"], h["width_mm"]
        moved = [{**h, "at_mm": at + sign * width * share} for sign in (-1.0, 1.0)]
        return [*moved, *({**h, "width_mm": width * factor} for factor in (0.5**share, 2.0**share))]

    return replace(unnamed("bump", "reading", 0.4, sizes(0.003, 1.0), hidden, actions), neighbours=neighbours)
