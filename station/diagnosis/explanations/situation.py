"""Where an error can act on the five-bar, and the effect of one unit of it on a reading or on the position.

An error adds something to a *target*: a joint angle (rad), a bearing centre, a link, the platform or the
reading (mm).  A `Situation` holds, for the readings or for a grid of the workspace, the derivative of the
outcome by every target and all quantities that errors depend on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np

from station.five_bar import FiveBar, Geometry, Pose, distance_by_joint, distance_jacobian, position_jacobian
from station.mechanism import Reference, last_way, readings_before
from station.records import Complex, Index, Real

TARGETS = (
    "joint1", "joint2", "e1x", "e1y", "e2x", "e2y", "L1", "L2", "l1", "l2", "shift_x", "shift_y", "reading",
)  # fmt: skip
PARAMETERS = 12
"""Parameters of `station.error_model`; the first ten have the same order as the targets."""


class Action(NamedTuple):
    """A number of shapes added to one target: V members with q amplitudes each."""

    target: str
    basis: Real
    """(V, K, q)"""


@dataclass(frozen=True)
class Situation:
    """K readings (m = 1: mm along the scale) or K positions of a grid (m = 2: x and y of P, mm)."""

    by_parameter: Real
    """(K, m, P) derivative with respect to the base parameters."""
    by_target: Real
    """(K, m, 13) derivative with respect to the targets."""
    t_s: Real
    theta: Real
    """(K, 2) rad, zero offsets included."""
    drive_angle: Real
    """(K, 2) rad from each drive's zero."""
    approach: Real
    """(K, 2) sign of each joint's last motion, 0 unknown."""
    travel: Real
    """(K,) mm, reading of a perfect scale."""
    slider: Real
    """(K, 4) sign of the slider's last motion and of its net travel, 0 unknown, and of its last motion if
    joint 1 or 2 alone arrives last.
    """
    rise: Real | None
    """(K,) temperature rise in K since the first reading; None if none was recorded or nothing changed."""
    payload_kg: Real | None
    mount: Real
    """(K,) number of the mechanism's mount."""
    place: Real
    """(K, 2) x and y, -1 to 1 over the workspace."""
    phi: Real
    """(K, 2) angle of the distal links, rad."""
    way: Real
    """(K, 2) rad, motion of each joint since the previous reading; 0 unknown."""
    drawn: Real
    """(K,) mm, motion of the slider since the previous reading; 0 unknown."""
    direction: Real
    """(K, 2) unit vector from O_1 to O_2."""
    force: Real
    """(K, 2) axial force of the distal links for a unit weight at P, positive in tension."""

    def __len__(self) -> int:
        return len(self.t_s)

    def take(self, rows: Index) -> Situation:
        """The situation of these readings only."""
        taken = {
            f.name: value[rows]
            for f in fields(self)
            if isinstance(value := getattr(self, f.name), np.ndarray)
        }
        return replace(self, **taken)

    def columns(self, actions: Sequence[Action]) -> Real:
        """(V, K * m, q) contribution of one unit of every amplitude to the outcome, mm."""
        rows, width = self.by_target.shape[:2]
        out: Real | None = None
        for target, basis in actions:
            by = self.by_target[:, :, TARGETS.index(target)]
            part = by[None, :, :, None] * basis[:, :, None, :]
            out = part if out is None else out + part
        assert out is not None, "an error without an action"
        return out.reshape(out.shape[0], rows * width, out.shape[3])


def at_readings(
    mechanism: FiveBar, p: Real, reference: Reference, added: Real | None = None, *, first: bool = True
) -> Situation:
    """The readings of a mechanism at base parameters p (P,); `added` (K, 13) is what errors add.

    `first` is False for readings that follow those that contain the reference.
    """
    c = mechanism.conditions(p, reference, first=first)
    at, geometry = posed(mechanism, p, added)
    jacobian = distance_jacobian(geometry, at)
    m = mechanism.measurements
    came_from = readings_before(m, None if first else reference)
    targets = np.column_stack([jacobian[:, :10], at.direction.real, at.direction.imag, np.ones(len(at.rho))])
    return Situation(
        by_parameter=mechanism.by_parameter(jacobian)[:, None, :],
        by_target=targets[:, None, :],
        t_s=c.t_s,
        theta=c.theta,
        drive_angle=c.drive_angle,
        approach=c.approach,
        travel=c.travel,
        slider=np.column_stack([c.slider_direction, c.slider_net, c.slider_by_joint]),
        rise=c.temperature_rise,
        payload_kg=None if c.payload_kg is None or not np.ptp(c.payload_kg) else c.payload_kg,
        mount=m.mount.astype(float),
        place=_normalised(mechanism, at.r),
        phi=np.angle(at.w),
        way=np.nan_to_num(last_way(m, came_from)[0]),
        drawn=np.nan_to_num(m.distance - came_from[:, -1]),
        direction=np.column_stack([at.direction.real, at.direction.imag]),
        force=_force(at),
    )


def predicted(mechanism: FiveBar, p: Real, added: Real | None = None) -> Real:
    """(K,) readings at base parameters p (P,) with `added` (K, 13) on the targets, mm."""
    at, _ = posed(mechanism, p, added)
    reading = at.rho - mechanism.offset(p)
    return np.asarray(reading if added is None else reading + added[:, 12])


class Commanded(NamedTuple):
    """The platform at G joint commands."""

    situation: Situation
    """m = 2"""
    r: Complex
    """(G,) position of P, mm, without the errors."""


class Around(NamedTuple):
    """The conditions under which G commands are carried out."""

    approach: Real
    """(G, 2) side from which each joint comes, 0 unknown."""
    rise: Real | None = None
    """(G,) temperature rise in K since the first reading; None: as at the last one."""
    payload_kg: Real | None = None
    """(G,); None: as at the last reading."""


def at_commands(mechanism: FiveBar, p: Real, last: Situation, theta: Real, around: Around) -> Commanded:
    """Joint commands theta (G, 2), rad, carried out after the last reading of `last`."""
    approach = around.approach
    base = mechanism.geometry_at(p)
    now = int(np.argmax(last.t_s))
    cd = base.cd if np.ndim(base.cd) == 0 else np.asarray(base.cd)[now]
    geometry = Geometry(base.e, base.L, base.l, complex(cd))
    actual = theta + p[:2]
    at = _pose(geometry, actual)
    count = len(theta)
    by_parameter = np.zeros((count, 2, len(mechanism.parameters)))
    by_parameter[:, :, :PARAMETERS] = position_jacobian(geometry, at)
    by_target = np.zeros((count, 2, len(TARGETS)))
    by_target[:, :, :10] = by_parameter[:, :, :10]
    by_target[:, 0, 10] = by_target[:, 1, 11] = 1.0
    by_each = distance_by_joint(at)
    moving = np.sign(np.sum(by_each * approach, axis=1))
    situation = Situation(
        by_parameter=by_parameter,
        by_target=by_target,
        t_s=np.full(count, last.t_s[now]),
        theta=actual,
        drive_angle=theta - np.radians(mechanism.robot.zero_at_deg),
        approach=approach,
        travel=at.rho - mechanism.offset(p)[now],
        slider=np.column_stack([moving, moving, np.sign(by_each * approach)]),
        rise=_given(around.rise, last.rise, now, count),
        payload_kg=_given(around.payload_kg, last.payload_kg, now, count),
        mount=np.full(count, last.mount[now]),
        place=_normalised(mechanism, at.r),
        phi=np.angle(at.w),
        way=np.zeros((count, 2)),
        drawn=np.zeros(count),
        direction=np.column_stack([at.direction.real, at.direction.imag]),
        force=_force(at),
    )
    return Commanded(situation, at.r)


def _given(wanted: Real | None, learned: Real | None, now: int, count: int) -> Real | None:
    """(G,) values as given, otherwise as at the last reading; None where nothing was learned about it."""
    if learned is None:
        return None
    return np.full(count, learned[now]) if wanted is None else wanted


def posed(mechanism: FiveBar, p: Real, added: Real | None) -> tuple[Pose, Geometry]:
    """The linkage at every reading, each with its own errors on the targets, `added` (K, 13)."""
    geometry = mechanism.geometry_at(p)
    theta = mechanism.theta + p[:2]
    if added is None:
        return _pose(geometry, theta), geometry
    own = Geometry(
        e=geometry.e + added[:, 2:6:2] + 1j * added[:, 3:6:2],
        L=geometry.L + added[:, 6:8],
        l=geometry.l + added[:, 8:10],
        cd=geometry.cd,
    )
    return _pose(own, theta + added[:, :2], added[:, 10] + 1j * added[:, 11]), own


def _pose(geometry: Geometry, theta: Real, shift: Complex | float = 0.0) -> Pose:
    """`station.error_model.pose` where lengths may be (K, 2) and the platform is moved by `shift` (K,)."""
    arm = geometry.L * np.exp(1j * theta)
    B = geometry.e + arm
    l = np.broadcast_to(geometry.l, B.shape)  # noqa: E741
    foot = B[:, 1]
    span = B[:, 0] - foot
    square = np.abs(span) ** 2
    along = 0.5 + 0.5 * (l[:, 1] ** 2 - l[:, 0] ** 2) / square
    across = np.sqrt(l[:, 1] ** 2 / square - along * along)
    r = foot + span * (along - 1j * across)
    lam = r + shift - geometry.cd
    rho = np.abs(lam)
    return Pose(r, rho, arm, (r[:, None] - B) / l, lam / rho)


def _force(at: Pose) -> Real:
    """(K, 2) w_1 f_1 + w_2 f_2 = (0, 1): the pull of each distal link that holds a unit weight."""
    both = np.stack([at.w.real, at.w.imag], axis=1)
    up = np.tile([0.0, -1.0], (len(at.w), 1))
    return np.asarray(np.linalg.solve(both, up[:, :, None])[:, :, 0])


def _normalised(mechanism: FiveBar, r: Complex) -> Real:
    (x0, x1), (y0, y1) = mechanism.robot.workspace_x, mechanism.robot.workspace_y
    u = (2.0 * r.real - x0 - x1) / (x1 - x0)
    v = (2.0 * r.imag - y0 - y1) / (y1 - y0)
    return np.column_stack([u, v])
