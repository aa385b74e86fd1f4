"""Whether something jumped during a calibration, and at which reading: the readout, or a joint's zero.

Lost counts of the readout shift every later reading by the same amount, a slipped joint every later angle.
The smooth model takes up part of that, and repeats before and after it make the noise look large, so a run
may look well; a jump at one reading, beside the model, then explains what is left over far better.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import chdtrc

from station.errors import InputRefused
from station.five_bar import FiveBar, Robot
from station.records import CalibrationResult, JumpNote, Reading, Real, Reason, because, from_readings

LEAST_MM = 0.03
"""What a jump shifts the readings by, root mean square; less may be creep or warming."""
READOUT = 0
"""Beside joints 1 and 2."""
JOINTS: dict[int, Literal["joint 1", "joint 2"]] = {1: "joint 1", 2: "joint 2"}
_ITERATIONS = 8
_DOUBT_P = 1e-3
_LEAST_GAIN = 30.0
"""Of chi-square, by the jump."""
_FITS = 4.0
"""Largest chi-square per degree of freedom that the jump may leave."""
_TRIED = 3
"""Best moments of each that are fitted in full: those beside the right one do nearly as well."""
_AS_WELL = 20.0
"""Of chi-square: another thing that jumped explains it as well."""


@dataclass(frozen=True, slots=True)
class Jump:
    """What jumped between two readings."""

    index: int
    """Of the first reading after it."""
    thing: int | None
    """`READOUT` or the joint; None: the readings do not say which."""
    size: float
    """mm of the readout, rad of the joint."""

    def reason(self, reading: int | str, position: str) -> Reason:
        """In words, for a first reading after it with this number and position."""
        if self.thing is None:
            return because("something_jumped", reading=reading, position=position)
        if self.thing == READOUT:
            size_um = round(self.size * 1e3, 1)
            return because("readout_jumped", reading=reading, position=position, jump_um=size_um)
        slip_deg = round(float(np.degrees(self.size)), 4)
        return because(
            "joint_slipped", reading=reading, position=position, joint=self.thing, slip_deg=slip_deg
        )

    def note(self, reading: int | str) -> JumpNote:
        """As documents show it."""
        if self.thing is None:
            text = f"Something jumped at reading {reading}: the readout or a joint."
            return JumpNote(reading=reading, thing=None, text=text)
        if self.thing == READOUT:
            text = f"The readout jumped by {self.size * 1e3:+.1f} um at reading {reading}."
            return JumpNote(reading=reading, thing="readout", size_mm=self.size, text=text)
        size_deg = float(np.degrees(self.size))
        text = f"Joint {self.thing} slipped by {size_deg:+.4f} deg at reading {reading}."
        return JumpNote(reading=reading, thing=JOINTS[self.thing], size_deg=size_deg, text=text)


@dataclass(frozen=True)
class _Fitted:
    """The model with all that is known of the machine, and perhaps a jump."""

    left: Real
    """(K + Q,) what is left of readings and of what is known, in standard deviations."""
    by_parameter: Real
    """(K + Q, P) derivatives, of the jump last."""
    size: float = 0.0

    @property
    def square(self) -> float:
        return float(self.left @ self.left)

    @property
    def basis(self) -> Real:
        """(K + Q, P) orthonormal, of all that the parameters can take up."""
        return np.asarray(np.linalg.qr(self.by_parameter)[0])


def find_jump(mechanism: FiveBar) -> Jump | None:
    """The jump that readings contradict the model by; None when they do not, or not by a jump.

    The geometry is free within its tolerances, the noise is that of the robot file.
    """
    without = _fitted(mechanism)
    if not np.isfinite(without.square):
        return None
    dof = len(without.left) - np.linalg.matrix_rank(without.by_parameter)
    if chdtrc(dof, without.square) > _DOUBT_P:
        return None
    found = [(_fitted(mechanism, thing, k), thing, k) for thing, k in _candidates(mechanism, without)]
    found = [item for item in found if np.isfinite(item[0].square)]
    if not found:
        return None
    best, thing, index = min(found, key=lambda item: item[0].square)
    shift = best.by_parameter[: len(mechanism.row_sd), -1] * mechanism.row_sd * best.size
    if (
        without.square - best.square < _LEAST_GAIN
        or float(np.sqrt(np.mean(shift[index:] ** 2))) < LEAST_MM
        or best.square > _FITS * (dof - 1)
    ):
        return None
    others = [other.square for other, what, _ in found if what != thing]
    alone = min(others, default=np.inf) > best.square + _AS_WELL
    return Jump(index, thing if alone else None, best.size)


def without_jump(result: CalibrationResult, robot: Robot, readings: Sequence[Reading]) -> CalibrationResult:
    """The result, or a failed one that names the reading at which something jumped."""
    try:
        jump = find_jump(FiveBar(robot, from_readings(list(readings))))
    except InputRefused:
        return result
    if jump is None:
        return result
    first = readings[jump.index]
    reason = jump.reason(first.reading, first.position)
    changed = {"verdict": "fail", "outcome": "unexplained", "reason": reason, "lack_of_fit": reason.text}
    return result.model_copy(update=changed)


def _candidates(mechanism: FiveBar, without: _Fitted) -> Iterator[tuple[int, int]]:
    """The thing and the moment of jumps that would gain most, linear about the fit without one."""
    count, basis = len(mechanism.row_sd), without.basis
    later = np.tril(np.ones((count, count)))
    for thing in (READOUT, 1, 2):
        by_jump = np.ones(count) if thing == READOUT else _by_joint(without, mechanism, thing)
        jumps = np.zeros((len(without.left), count))
        jumps[:count] = later * (by_jump / mechanism.row_sd)[:, None]
        jumps -= basis @ (basis.T @ jumps)
        square = np.einsum("ij,ij->j", jumps, jumps)
        gains = np.where(square > 1e-9, (jumps.T @ without.left) ** 2 / np.maximum(square, 1e-9), 0.0)
        gains[0] = 0.0  # a jump before the first reading is the unknown offset
        for k in np.argsort(gains)[::-1][:_TRIED]:
            if gains[k] > 0.0:
                yield thing, int(k)


def _by_joint(fitted: _Fitted, mechanism: FiveBar, joint: int) -> Real:
    """(K,) mm per rad of a joint."""
    return np.asarray(fitted.by_parameter[: len(mechanism.row_sd), joint - 1] * mechanism.row_sd)


def _fitted(mechanism: FiveBar, thing: int | None = None, index: int = 0) -> _Fitted:
    """The best fit, with a jump of `thing` at reading `index` or without one."""
    p, size = mechanism.start, 0.0
    prior_sd = np.array([parameter.prior_sd for parameter in mechanism.parameters])
    known = np.isfinite(prior_sd)
    pull = np.eye(len(p))[known] / prior_sd[known, None]
    sd = mechanism.row_sd
    later = np.arange(len(sd)) >= index
    for _ in range(_ITERATIONS):
        theta = mechanism.theta.copy()
        if thing:
            theta[later, thing - 1] += size
        at = mechanism.observe(p, theta)
        off = mechanism.measured - at.value
        by_parameter = np.vstack([at.by_parameter / sd[:, None], pull])
        if thing is not None:
            if thing == READOUT:
                off = off - size * later
            by_jump = (at.by_parameter[:, thing - 1] if thing else 1.0) * later / sd
            by_parameter = np.column_stack([by_parameter, np.append(by_jump, np.zeros(len(pull)))])
        left = np.concatenate([off / sd, pull @ (mechanism.start - p)])
        if not np.isfinite(left).all() or not np.isfinite(by_parameter).all():
            return _Fitted(np.full_like(left, np.inf), by_parameter)
        step = np.linalg.lstsq(by_parameter, left, rcond=None)[0]
        p = p + step[: len(p)]
        size += 0.0 if thing is None else float(step[-1])
    return _Fitted(left, by_parameter, size)
