"""Translation of taught positions to new zeros: joint angles of the same physical positions.

The actual angle of a joint is the angle of its drive plus the drive's zero offset. The zero offsets before
and now, each with its uncertainty, give the new angle and the resulting position uncertainty of the platform.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from station.errors import NotApplicable
from station.five_bar import Robot, excess_mm, pose, position_jacobian
from station.identification import zero_difference
from station.motion import shift_of
from station.records import Real, TaughtPosition, TranslatedPosition
from station.run_kinds.apply import source_of
from station.run_kinds.lock import check_not_locked
from station.run_kinds.zero_state import application
from station.settings import JointSettings
from station.store import Store

NEAR_SINGULAR = 0.15
"""Sine of the angle between the distal links below which the platform is nearly unconstrained."""
MARGIN_MM = 5.0
K95 = 2.4477
"""Radius that contains 95 % of two-dimensional normal errors, in standard deviations of the larger axis."""


@dataclass(frozen=True)
class Change:
    """The change from the frame in which positions were taught to the present frame of the drives."""

    robot: Robot
    shift: Real
    """(2,) rad, to be added to taught angles."""
    covariance: Real
    """(2, 2) rad^2, covariance of the remaining difference of the actual angles."""

    def back(self) -> Change:
        """The inverse change, which restores the original positions."""
        return replace(self, shift=-self.shift)


def change_of(store: Store, run_id: int, taught_under: int | None = None) -> Change:
    """:param taught_under: the run after whose application positions were taught; None: before `run_id` was.

    :raises NotFound: no such run.
    :raises NotApplicable: it is not applied, or the zeros in the drives are unknown; the error states why.
    """
    run = store.calibration(run_id)
    known = application(store, run)
    if known is None or known.state != "applied":
        raise NotApplicable(
            f"Run {run_id} is not what the drives hold: {known.text if known else 'it has not passed.'}"
            " Taught positions are as they were."
        )
    check_not_locked(store, run_id)
    robot = store.robot_of(run_id)
    now = shift_of(store.zero_writes(run.robot_serial, since=run_id))
    if taught_under is None:
        # the drives' own frames moved by the written values only
        return Change(robot, -np.radians(now), np.eye(2) * 2.0 * np.radians(robot.pulse_deg) ** 2 / 12.0)
    earlier = store.calibration(taught_under)
    if earlier.robot_serial != run.robot_serial:
        raise NotApplicable(f"Run {taught_under} is of robot {earlier.robot_serial}, not {run.robot_serial}.")
    written = store.zero_writes(run.robot_serial, since=taught_under)
    after = [write for write in written if write.of == taught_under]
    if not after:
        raise NotApplicable(f"Run {taught_under} was never applied; nothing was taught under it.")
    old, new = source_of(store, taught_under).fit, source_of(store, run_id).fit
    moved, covariance = zero_difference(old, new, same_mounting=_same_mounting(store, taught_under, run_id))
    return Change(robot, moved + np.radians(shift_of(after)) - np.radians(now), covariance)


def _same_mounting(store: Store, earlier: int, later: int) -> bool:
    """Whether every run between them found the mechanism as the previous run had left it."""
    while later > earlier:
        use = store.calibration(later).memory
        if use is None or not use.used:
            return False
        later = use.from_calibration
    return later == earlier


def translated(
    change: Change, taught: Sequence[TaughtPosition], joints: Sequence[JointSettings]
) -> tuple[TranslatedPosition, ...]:
    """The same physical positions in the drives' present frame, marked where a limit is near."""
    theta = np.radians([[t.theta1_deg, t.theta2_deg] for t in taught]).reshape(-1, 2)
    new = theta + change.shift
    with np.errstate(invalid="ignore"):
        at = pose(change.robot.geometry, new)
        by_zero = position_jacobian(change.robot.geometry, at)[:, :, :2]
    spread = by_zero @ change.covariance @ np.swapaxes(by_zero, 1, 2)
    u95_mm = K95 * np.sqrt(np.linalg.eigvalsh(np.nan_to_num(spread))[:, 1])
    held = np.abs((at.w[:, 0].conj() * at.w[:, 1]).imag)
    out = []
    for k, position in enumerate(taught):
        degrees = np.degrees(new[k])
        closes = bool(np.isfinite(at.r[k]))
        within = (
            closes and _within(change.robot, complex(at.r[k]), degrees, joints) and held[k] > NEAR_SINGULAR
        )
        out.append(
            TranslatedPosition(
                position=position.position,
                theta1_deg=float(degrees[0]),
                theta2_deg=float(degrees[1]),
                u95_mm=float(u95_mm[k]) if closes else None,
                within_limits=bool(within),
            )
        )
    return tuple(out)


def _within(robot: Robot, place: complex, degrees: Real, joints: Sequence[JointSettings]) -> bool:
    inside = bool(excess_mm(robot, np.array([place]))[0] <= MARGIN_MM)
    reach = all(
        abs(float(angle) - joint.zero_at_deg) <= joint.reach_deg
        for angle, joint in zip(degrees, joints, strict=True)
    )
    return inside and reach
