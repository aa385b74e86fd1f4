"""Unnamed errors with mechanical structure: low harmonics of turning parts, shifts by position or load.

They have no entry in the catalogue, but the true error is often among them; general smooth curves alone do
not describe it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from station.diagnosis.explanations.family import Family, Hidden, Part, nothing, side_by_side, sizes
from station.diagnosis.explanations.rough_families import DEG, wave
from station.diagnosis.explanations.situation import Action, Situation
from station.records import Real

RARE = 0.5
"""Prior weight of an unnamed error, relative to one of the catalogue."""
TURNS = ({"per_turn": 1.0}, {"per_turn": 2.0}, {"per_turn": 3.0})
NAMED = ((TURNS[0], 3), (TURNS[0], 4))
"""Once per turn square to the arm is an eccentric encoder; on a circle with the arm it is another length."""
PLACE_FACTORS = 6
LOADS = 4
CHANGES = (-2.0, -1.0, -0.5, 0.5, 1.0, 2.0)
TRAVEL = np.pi / 4.0
"""Travel of a joint, rad, at which its stiffness has changed by such a share."""
STRETCH = sizes(0.004, 1.0)
Field = Callable[[Situation, Sequence[Hidden]], Real]


def structured_families() -> tuple[Family, ...]:
    """Families of both joints, of their bearings, and of frame and platform."""
    angle = sizes(0.002 * DEG, 0.3 * DEG)
    centre, length = sizes(0.004, 1.0), sizes(0.004, 1.0)
    return (
        *(_harmonic(i, angle) for i in (1, 2)),
        _both_harmonics(angle),
        *(_uneven_stiffness(i) for i in (1, 2)),
        *(_centre(i, centre) for i in (1, 2)),
        *(_path(i, centre) for i in (1, 2)),
        _both_centres(centre),
        *(_elbow(i, length) for i in (1, 2)),
        *(
            family
            for axis in "xy"
            for moves in (True, False)
            for family in (
                _shift("platform by place", axis, _place_factor, PLACE_FACTORS, 0.4, moves=moves),
                _shift("platform by load", axis, _load, LOADS, 0.2, moves=moves),
            )
        ),
        *(_tilt(moves=moves) for moves in (True, False)),
        *(_bearing_load(f"e{i}{axis}", 0.2) for i in (1, 2) for axis in "xy"),
        *(_both_bearings(axis, sign) for axis in "xy" for sign in (1.0, -1.0)),
        *(_stretch(f"{kind}{i}", 0.15) for kind in "Ll" for i in (1, 2)),
        *(_both_stretch(kind) for kind in "Ll"),
    )


def unnamed(
    kind: str,
    depends_on: str,
    weight: float,
    range_: Real,
    hidden: tuple[Hidden, ...],
    actions: Callable[[Situation, Sequence[Hidden]], list[Action]],
) -> Family:
    """A family that has no name in the catalogue."""
    part = Part("unnamed", None, kind, (), nothing)
    return Family(kind, (part,), RARE * weight, range_, hidden, actions, depends_on=depends_on)


def _turns(hidden: Sequence[Hidden]) -> list[float]:
    return [h["per_turn"] for h in hidden]


def _harmonic(joint: int, range_: Real) -> Family:
    """The angle of a joint, two or three times per turn; once is the encoder's eccentricity."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"joint{joint}", wave(s.theta[:, joint - 1], _turns(hidden)))]

    return unnamed("joint harmonic", f"joint{joint}", 0.5, range_, TURNS[1:], actions)


def _both_harmonics(range_: Real) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        waves = [wave(s.theta[:, i], _turns(hidden)) for i in (0, 1)]
        return side_by_side(("joint1", "joint2"), waves)

    return unnamed("joint harmonic", "joint1", 0.3, range_, TURNS[1:], actions)


def _uneven_stiffness(joint: int) -> Family:
    """A drive that sags under its arm, by a share that changes with a power of its travel."""
    hidden = tuple({"power": n, "change": c} for n in (1.0, 2.0, 3.0) for c in CHANGES)

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        own, turned = np.cos(s.theta[:, joint - 1]), s.drive_angle[:, joint - 1] / TRAVEL
        sags = [own * (1.0 + h["change"] * turned ** int(h["power"])) for h in hidden]
        return [Action(f"joint{joint}", np.stack(sags)[:, :, None])]

    return unnamed("uneven stiffness", f"joint{joint}", 0.3, sizes(0.002 * DEG, 0.1 * DEG), hidden, actions)


def _centre(joint: int, range_: Real) -> Family:
    """The centre of an active joint moves in x and y while the joint turns."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        turning = wave(s.theta[:, joint - 1], _turns(hidden))
        return side_by_side((f"e{joint}x", f"e{joint}y"), (turning, turning))

    return unnamed("bearing centre", f"joint{joint}", 0.12, range_, TURNS, actions)


def _path(joint: int, range_: Real) -> Family:
    """The same on a line (x, y, along the arm, square to it) or a circle, with or against the turning."""
    hidden = tuple(
        {**turns, "form": float(form)} for turns in TURNS for form in range(6) if (turns, form) not in NAMED
    )

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        theta = s.theta[:, joint - 1]
        along, up = np.cos(theta)[:, None], np.sin(theta)[:, None]
        x, y = [], []
        for h, turning in zip(hidden, wave(theta, _turns(hidden)), strict=True):
            square = np.stack([-turning[:, 1], turning[:, 0]], axis=1)
            none = np.zeros_like(turning)
            dx, dy = (
                (turning, none),
                (none, turning),
                (turning * along, turning * up),
                (-turning * up, turning * along),
                (turning, -square),
                (turning, square),
            )[int(h["form"])]
            x.append(dx)
            y.append(dy)
        return [Action(f"e{joint}x", np.stack(x)), Action(f"e{joint}y", np.stack(y))]

    return unnamed("bearing centre", f"joint{joint}", 0.3, range_, hidden, actions)


def _both_centres(range_: Real) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        first, second = (wave(s.theta[:, i], _turns(hidden)) for i in (0, 1))
        return side_by_side(("e1x", "e1y", "e2x", "e2y"), (first, first, second, second))

    return unnamed("bearing centre", "joint1", 0.3, range_, TURNS, actions)


def _elbow(joint: int, range_: Real) -> Family:
    """The passive bearing between the links: along the distal link, by the angle between both.

    Once per turn is another length of the arm and another zero.
    """

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        i = joint - 1
        return [Action(f"l{joint}", wave(s.phi[:, i] - s.theta[:, i], _turns(hidden)))]

    return unnamed("elbow bearing", f"joint{joint}", 0.25, range_, TURNS[1:], actions)


def _numbered(count: int) -> tuple[Hidden, ...]:
    return tuple({"form": float(k)} for k in range(count))


def _chosen(shapes: Sequence[Real], hidden: Sequence[Hidden]) -> Real:
    """(V, K, 1)"""
    return np.stack(shapes)[[int(h["form"]) for h in hidden]][:, :, None]


def _place_factor(s: Situation, hidden: Sequence[Hidden]) -> Real:
    u, v = s.place.T
    return _chosen((u, v, u * u, v * v, u * v, u**3), hidden)


def _load(s: Situation, hidden: Sequence[Hidden]) -> Real:
    """Weight of both arms, their difference, and the same for the platform's pull on the links."""
    own = np.cos(s.theta)
    pull = s.force
    return _chosen(
        (own[:, 0] - own[:, 1], own[:, 0] + own[:, 1], pull[:, 0] - pull[:, 1], pull[:, 0] + pull[:, 1]),
        hidden,
    )


def _shift(kind: str, axis: str, field: Field, count: int, weight: float, *, moves: bool) -> Family:
    """P moves with the shift, or only the current point of the platform (or of the base).

    No reading can distinguish the two.
    """

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        shapes = field(s, hidden)
        if moves:
            return [Action(f"shift_{axis}", shapes)]
        return [Action("reading", shapes * s.direction[:, "xy".index(axis), None])]

    name = kind if moves else kind.replace("platform", "mechanism")
    return unnamed(name, "place", weight, sizes(0.004, 3.0), _numbered(count), actions)


def of_mechanism(s: Situation, shapes: Real) -> Action:
    """Shapes (K, q) of a shift in x, and the same in y, of the mounting point of the mechanism."""
    return Action("reading", np.hstack([shapes * s.direction[:, [k]] for k in (0, 1)])[None])


def _tilt(*, moves: bool) -> Family:
    """Sideways and down at once, each in proportion to x and y: frame or platform turn during the motion."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        if moves:
            return side_by_side(("shift_x", "shift_y"), (s.place[None], s.place[None]))
        return [of_mechanism(s, s.place)]

    name = "platform by place" if moves else "mechanism by place"
    return unnamed(name, "place", 0.2, sizes(0.004, 3.0), ({},), actions)


def _bearing_forms(s: Situation, joint: int, axis: str, hidden: Sequence[Hidden]) -> Real:
    """The loads on a centre: the arm's weight by its lever, and the platform through the links."""
    i = joint - 1
    along = np.cos(s.phi[:, i]) if axis == "x" else np.sin(s.phi[:, i])
    return _chosen((np.cos(s.theta[:, i]), s.force[:, i] * along, np.sin(s.theta[:, i])), hidden)


def _bearing_load(target: str, weight: float) -> Family:
    joint, axis = int(target[1]), target[2]

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(target, _bearing_forms(s, joint, axis, hidden))]

    return unnamed("bearing under load", f"joint{joint}", weight, sizes(0.004, 1.0), _numbered(3), actions)


def _both_bearings(axis: str, sign: float) -> Family:
    """Both centres deflect alike, in the same or in opposite sense: a flexible frame."""

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        first = _bearing_forms(s, 1, axis, hidden)
        return [Action(f"e1{axis}", first), Action(f"e2{axis}", sign * _bearing_forms(s, 2, axis, hidden))]

    return unnamed("frame under load", "place", 0.3, sizes(0.004, 1.0), _numbered(3), actions)


def _stretch_forms(s: Situation, kind: str, i: int, hidden: Sequence[Hidden]) -> Real:
    """The platform's pull and the arm's weight; a distal link also sags between its ends, in proportion to
    the square of the cosine of its inclination.
    """
    flat = s.theta[:, i] if kind == "L" else s.phi[:, i]
    return _chosen((s.force[:, i], np.cos(s.theta[:, i]), np.cos(flat) ** 2), hidden)


def _stretch(target: str, weight: float) -> Family:
    """A link stretches under the pull of the platform, or bends under the weight of the arm."""
    i = int(target[1]) - 1

    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(target, _stretch_forms(s, target[0], i, hidden))]

    return unnamed("link under load", f"joint{i + 1}", weight, STRETCH, _numbered(3), actions)


def _both_stretch(kind: str) -> Family:
    def actions(s: Situation, hidden: Sequence[Hidden]) -> list[Action]:
        return [Action(f"{kind}{i + 1}", _stretch_forms(s, kind, i, hidden)) for i in (0, 1)]

    return unnamed("link under load", "place", 0.2, STRETCH, _numbered(3), actions)
