"""Kinematics of a serial arm: a chain of rotations and translations, with every derivative in closed form.

A joint rotates about z or slides along z; the variable of a sliding joint is in metres, so that one unit of
any joint moves the end about equally.

The standard Denavit-Hartenberg form rotates and translates about z by theta and d, then about x by alpha and
a; in the modified form (Craig) the pair about x comes first. Between the two each link has one more
translation along y and one more rotation about y (Hayati and Mirmirani, 1985), so that six errors per link
describe every error of a rigid link, parallel axes included.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from station.records import Real

Convention = Literal["standard", "modified"]

LINK_ERRORS = ("dtheta", "d", "a", "alpha", "b", "beta")
"""Errors of one link: about z, along z, along x, about x, along y, about y."""
MM = 1000.0
"""Millimetres per metre."""
_X, _Y, _Z = 0, 1, 2
_STANDARD = (
    ("turn", _Z, "dtheta"), ("shift", _Z, "d"), ("shift", _X, "a"), ("turn", _X, "alpha"),
    ("shift", _Y, "b"), ("turn", _Y, "beta"),
)  # fmt: skip
_MODIFIED = (
    ("turn", _X, "alpha"), ("shift", _X, "a"), ("shift", _Y, "b"), ("turn", _Y, "beta"),
    ("turn", _Z, "dtheta"), ("shift", _Z, "d"),
)  # fmt: skip


@dataclass(frozen=True)
class Links:
    """Nominal links of an arm with n joints."""

    a: Real
    """(n,) mm"""
    d: Real
    """(n,) mm"""
    alpha: Real
    """(n,) rad"""
    offset: Real
    """(n,) rad, added to the joint angle."""
    convention: Convention = "standard"
    sliding: tuple[int, ...] = ()
    """Joints that slide, counted from 0."""

    def __len__(self) -> int:
        return len(self.a)


class Reach(NamedTuple):
    """The arm at K poses, in the frame of its base."""

    end: Real
    """(K, 3) mm, the tool point."""
    by_link: Real
    """(K, 3, n, 6) d end / d the six errors of each link, in the order of `LINK_ERRORS`, mm and rad."""
    by_tool: Real
    """(K, 3, 3) d end / d the tool point in the frame of the last link: that frame's axes."""
    by_joint: Real
    """(K, 3, n) mm for one unit of each joint's variable."""
    origins: Real
    """(K, n + 1, 3) mm, the origin of the base and of each link."""
    axes: Real
    """(K, n, 3) the joint axes."""
    pivots: Real
    """(K, n, 3) mm, a point on each of them."""


def reach(links: Links, errors: Real, tool: Real, theta: Real) -> Reach:
    """Forward kinematics and its derivatives.

    errors (n, 6) in the order of `LINK_ERRORS`; tool (3,) or (K, 3) mm in the frame of the last link; theta
    (K, n) rad, m for sliding joints.
    """
    count, n = theta.shape
    frame: Real = np.tile(np.eye(3), (count, 1, 1))
    origin: Real = np.zeros((count, 3))
    # every elementary motion: along or about which axis, through which point
    motions: list[tuple[str, int, int, Real, Real]] = []
    origins, axes, pivots = [origin], [], []
    for i in range(n):
        e = dict(zip(LINK_ERRORS, errors[i], strict=True))
        turned, slid = (0.0, MM * theta[:, [i]]) if i in links.sliding else (theta[:, i], 0.0)
        amounts = {
            "dtheta": turned + links.offset[i] + e["dtheta"],
            "d": slid + links.d[i] + e["d"],
            "a": links.a[i] + e["a"],
            "alpha": links.alpha[i] + e["alpha"],
            "b": e["b"],
            "beta": e["beta"],
        }
        for kind, axis, name in _STANDARD if links.convention == "standard" else _MODIFIED:
            along = frame[:, :, axis]
            motions.append((kind, i, LINK_ERRORS.index(name), along, origin))
            if name == "dtheta":
                axes.append(along)
                pivots.append(origin)
            if kind == "shift":
                origin = origin + along * amounts[name]
            else:
                frame = _turned(frame, axis, amounts[name])
        origins.append(origin)
    end = origin + np.einsum("kij,kj->ki", frame, np.broadcast_to(tool, (count, 3)))
    by_link = np.empty((count, 3, n, len(LINK_ERRORS)))
    turns = [(i, k, along, through) for kind, i, k, along, through in motions if kind != "shift"]
    # all at once: for a short log the calls take longer than the products
    about_each = np.stack([along for _, _, along, _ in turns], axis=1)
    moved = np.cross(about_each, end[:, None] - np.stack([through for *_, through in turns], axis=1))
    for j, (i, k, _, _) in enumerate(turns):
        by_link[:, :, i, k] = moved[:, j]
    for kind, i, k, along, _ in motions:
        if kind == "shift":
            by_link[:, :, i, k] = along
    along_path, about, through_point = (np.stack(part, axis=1) for part in (origins, axes, pivots))
    columns = [MM * by_link[:, :, i, 1] if i in links.sliding else by_link[:, :, i, 0] for i in range(n)]
    return Reach(end, by_link, frame, np.stack(columns, axis=2), along_path, about, through_point)


def _turned(frame: Real, axis: int, angle: float | Real) -> Real:
    """(K, 3, 3) frames rotated about one of their axes by an angle or (K,) angles, rad."""
    c, s = np.cos(angle), np.sin(angle)
    if np.ndim(angle):
        c, s = c[:, None], s[:, None]
    first, second = frame[:, :, (axis + 1) % 3], frame[:, :, (axis + 2) % 3]
    turned = frame.copy()
    turned[:, :, (axis + 1) % 3] = first * c + second * s
    turned[:, :, (axis + 2) % 3] = second * c - first * s
    return turned
